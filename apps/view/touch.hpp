#pragma once
// Mouse interaction with the scene: pushing fluid with a ball, moving solids, pulling bodies, throwing fluid and crates.
#include <array>

#include "view/pick.hpp"
#include "view/session.hpp"

namespace rill::view {

enum class Hold { Fluid, Solid };

class Touch {
 public:
  /// Grabs the first hit of the ray, if it is of the kind `hold`: adds a ball in front of the fluid's surface, pulls a body by the point
  /// that was hit, or makes another solid a driven one. False for a hit of another kind.
  Expected<bool> grab(Session& session, const CameraView& eye, const Ray& ray, Hold hold);
  /// Moves the grabbed solid or ball to the ray, in the plane parallel to the image through its last position, at most at
  /// maxSpeed(); pulls a body there.
  void drag(Session& session, const CameraView& eye, const Ray& ray);
  /// Removes the ball; a body is free, another solid stays where it is.
  Expected<void> release(Session& session);
  bool holds() const { return solid_.has_value(); }
  /// Of a body that is pulled: the point that it was grabbed by, and where it is pulled to, m in the scene.
  std::optional<std::array<Double3, 2>> pullLine(const Session& session) const;
  /// Call after the scene was restarted.
  void reset() { solid_.reset(); }

  /// Adds a ball of the scene's `fluid` (empty: the first) where the ray enters the scene, moving along the ray. BadInput where there is no
  /// room.
  static Expected<uint64_t> throwFluid(Session& session, const Ray& ray, const std::string& fluid = {});
  /// Adds a box with a body at the first place on the ray, within the scene and before what it hits, where there is room, moving along the
  /// ray. BadInput where it has no room.
  static Expected<void> throwCrate(Session& session, const Ray& ray);

  /// m/s: the scene's longest side per second.
  static double maxSpeed(const Session& session);
  static double ballRadius(const Session& session);  ///< m
  static double crateEdge(const Session& session);   ///< m

 private:
  enum class Grabbed { Ball, Body, Other };
  std::optional<uint32_t> solid_;
  Grabbed kind_ = Grabbed::Other;
  BodyPull pull_;                          // of a body
  Double3 point_{}, normal_{}, offset_{};  // of the drag plane; from its point to the solid's center
};

}  // namespace rill::view
