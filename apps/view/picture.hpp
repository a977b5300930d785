#pragma once
// The picture of the scene in the window, drawn anew where something of it has changed.
#include <string>

#include "view/display.hpp"
#include "view/pacing.hpp"

namespace rill::view {

class Picture {
 public:
  /// What it is to show.
  struct Wish {
    std::string view;
    CameraView eye;
    Area area;
    double scale = 0;      ///< pixels of it over pixels of the window, a side; 0: as the machine allows
    bool changed = false;  ///< the scene
  };
  /// BadInput where that cannot be drawn from there: the old picture stays, where there is one.
  Expected<void> paint(Display& display, Session& session, const Wish& wish);
  /// After a scene began: what was learnt of its cost is forgotten.
  void restart() { auto_.restart(); }

  bool any() const { return area_.width > 0; }
  double scale() const { return scale_; }
  double seconds() const { return took_s_; }  ///< device time of the last one that is known

 private:
  bool shows(const Wish& wish, double scale) const;

  PictureScale auto_;
  CameraView eye_;
  std::string view_;
  Area area_;
  double scale_ = 1, took_s_ = 0;
};

}  // namespace rill::view
