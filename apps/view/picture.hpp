#pragma once
// The image of the scene in the window, drawn again when something changes.
#include <string>

#include "view/display.hpp"
#include "view/picture_scale.hpp"

namespace rill::view {

class Picture {
 public:
  /// What to draw.
  struct Request {
    std::string view;
    CameraView eye;
    Area area;
    double exposure_stops = 0;
    double scale = 0;      ///< image over window resolution, per side; 0: automatic
    bool changed = false;  ///< the scene has changed
  };
  /// BadInput where the view cannot be drawn from this camera; the previous image stays.
  Expected<void> paint(Display& display, Session& session, const Request& request);
  /// Call after a restart: resets the automatic scale.
  void restart() { auto_.restart(); }

  bool any() const { return area_.width > 0; }
  double scale() const { return scale_; }
  double seconds() const { return took_s_; }  ///< device time of the last measured image

 private:
  bool shows(const Request& request, double scale) const;

  PictureScale auto_;
  CameraView eye_;
  std::string view_;
  Area area_;
  double exposure_stops_ = 0, scale_ = 1, took_s_ = 0;
};

}  // namespace rill::view
