#pragma once
// A hand in the scene: it pushes the fluid with a ball, moves solids, throws fluid.
#include "view/pick.hpp"
#include "view/session.hpp"

namespace rill::view {

enum class Hold { Fluid, Solid };

class Touch {
 public:
  /// Takes hold of what the ray meets first, where that is of this kind; the scene gets a ball that stands before the fluid's surface, or
  /// its solid becomes one that is driven. False: it is something else.
  Expected<bool> grab(Session& session, const CameraView& eye, const Ray& ray, Hold hold);
  /// What is held follows the ray, in the plane of the picture through where it was last, as fast as the hand may be.
  void drag(Session& session, const CameraView& eye, const Ray& ray);
  /// The ball is gone; a solid stays where it is.
  Expected<void> release(Session& session);
  bool holds() const { return solid_.has_value(); }
  /// After the scene began anew.
  void forget() { solid_.reset(); }

  /// A ball of fluid comes in where the ray enters the scene, and flies along it. BadInput where there is no room.
  static Expected<uint64_t> throwFluid(Session& session, const Ray& ray);

  /// m/s: through the scene in a second.
  static double fastest(const Session& session);
  static double ballRadius(const Session& session);  ///< m

 private:
  std::optional<uint32_t> solid_;
  bool ball_ = false;                                    // of its own
  std::array<double, 3> point_{}, normal_{}, offset_{};  // of the plane; from where the ray meets it to the solid's center
};

}  // namespace rill::view
