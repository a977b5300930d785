#pragma once
// Rigid bodies of the reference: prediction, contacts with walls and other solids, and what the fluid's solve gives them. The
// equations are in docs/notes/bodies.md.
#include <cmath>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "reference/images.hpp"
#include "rill/scene.hpp"
#include "shape/contact_points.hpp"
#include "shape/pose.hpp"

namespace rill::reference {

inline glm::dvec3 vec(const Double3& v) { return {v.x, v.y, v.z}; }
inline bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
inline Double3 triple(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// Where a body is and how fast it moves, relative to the origin of the positions.
struct BodyMotion {
  glm::dvec3 center = {0, 0, 0};           ///< of mass, m
  glm::dquat rotation = {1, 0, 0, 0};      ///< from the solid's frame to the scene's
  glm::dvec3 velocity = {0, 0, 0};         ///< m/s
  glm::dvec3 angularVelocity = {0, 0, 0};  ///< rad/s
};

/// Linear and angular, N s and N m s or another product with a mass; about a solid's center where nothing else is said.
struct Impulse {
  glm::dvec3 linear = {0, 0, 0}, angular = {0, 0, 0};
};

/// A spring that pulls a body, as rill::BodyPull.
struct Pull {
  size_t solid = 0;
  glm::dvec3 point = {0, 0, 0};   ///< m, in the solid's frame
  glm::dvec3 target = {0, 0, 0};  ///< m, relative to the origin of the positions
  double rate = 0;                ///< rad/s, without damping
  double dampingRatio = 1;
  double maxForce = 0;  ///< N
};

class Bodies {
 public:
  /// The closest point of the surface of a solid with a pose.
  using Surface = std::function<SurfacePoint(size_t solid, const Pose& pose, const glm::dvec3& x)>;

  Bodies(const std::vector<Solid>& solids, const glm::dvec3& origin, const Walls& walls, double spacing, double separationSpeed);

  bool any() const { return !bodies_.empty(); }
  bool isBody(size_t solid) const { return indexOf_[solid] >= 0; }
  const BodyMotion& motion(size_t solid) const { return bodies_[index(solid)].state; }
  double fastest() const { return fastest_; }  ///< bounds the speed of every point of the bodies, m/s
  bool isFree(size_t solid) const { return isBody(solid) && !bodies_[index(solid)].held; }
  /// Predicted during a substep, else where it is.
  Pose poseOf(size_t solid) const;

  /// Predicts a substep of `dt` that begins at `time`, both s, then solves contacts. `warm`: impulses of the warm start on all solids;
  /// `poses`: of all solids, those of bodies are replaced. `atRest`: without their velocities and pulls, as for the initial pressure.
  void predict(double time, double dt, const glm::dvec3& gravity, std::span<const Impulse> warm, std::span<const Pull> pulls,
               std::vector<Pose> poses, bool atRest, Surface surface);
  /// Moves predictions by what the solve gave solids. Called after each iteration.
  void react(std::span<const Impulse> solve, double dt);
  /// Predictions become the motions.
  void end(double dt);
  /// A particle that sticks to a solid.
  struct Held {
    size_t solid = 0;
    double mass = 0;                  ///< kg, times b of docs/notes/slip.md
    glm::dvec3 at = {0, 0, 0};        ///< m
    glm::dvec3 relative = {0, 0, 0};  ///< m/s, velocity relative to the solid
  };
  /// After end(): a body's pose, with the velocity at which the impulses of the particles that stick to it are those that gave it that.
  Pose stuckPose(size_t solid, std::span<const Held> particles) const;
  /// After end(): changes velocities by impulses on all solids.
  void accelerate(std::span<const Impulse> impulses);
  void forgetPrediction();  ///< after an iteration for the initial pressure

  /// Root of |grad B|^2 w: w is the mobility of a body along the gradient at x, 1/kg. 0 for other solids.
  double root(size_t solid, const glm::dvec3& x, const glm::dvec3& gradient) const;
  void beginStiffness();  ///< of the next substep
  /// Adds a particle to it.
  void addRoot(size_t solid, double root, double particleMass);
  double stiffness(size_t solid) const { return isFree(solid) ? bodies_[index(solid)].stiffness : 0; }
  /// The part of a change of a particle's velocity along a direction that a solid takes the reaction of; 1 of solids that are not free.
  double share(size_t solid, const glm::dvec3& x, const glm::dvec3& direction) const;

 private:
  struct Slip {
    int partner = -1;  // a solid, or as many as there are solids and a side of the domain; -1: none
    glm::dvec3 slipped = {0, 0, 0};
    double limit = 0;
  };
  struct RigidBody {
    size_t solid = 0;
    double mass = 0, from = 0, radius = 0;
    glm::dvec3 offset = {0, 0, 0};
    glm::dmat3 inertia{1};  // about the center of mass, in the solid's frame
    FreedomMask locked = 0;
    std::vector<ContactPoint> points;
    std::vector<Slip> slips;
    std::vector<size_t> touched;
    BodyMotion state, predicted;
    bool held = false;
    double stiffness = 0, nextStiffness = 0;
    int contacts = 0;
  };
  struct Partner {
    int name = 0;
    int body = -1;
    double friction = 0, restitution = 0;
    glm::dvec3 moved = {0, 0, 0}, before = {0, 0, 0};
  };
  struct Contact {
    Partner own, other;
    glm::dvec3 at, normal;
    double depth = 0;
  };

  size_t index(size_t solid) const { return static_cast<size_t>(indexOf_[solid]); }
  double contactMargin() const { return 0.25 * spacing_; }
  Pose poseOf(const RigidBody& body, const BodyMotion& motion) const;
  Impulse aboutMass(const RigidBody& body, const Impulse& impulse) const;
  void push(RigidBody& body, const Impulse& impulse, double dt);
  double mobility(const RigidBody& body, const glm::dvec3& at, const glm::dvec3& direction) const;
  double compliance(const Partner& partner, const glm::dvec3& at, const glm::dvec3& direction) const;
  Partner partnerOf(size_t solid, const glm::dvec3& at, double dt) const;
  /// What a spring adds to a body's velocity and angular momentum in a step.
  void applyPull(const Pull& pull, const RigidBody& body, double dt, glm::dvec3& velocity, glm::dvec3& momentum) const;
  void findTouched();
  void forEachContact(const RigidBody& body, const ContactPoint& point, double margin, double dt,
                      const std::function<void(const Contact&)>& visit) const;
  void findFastest();
  void countContacts(double dt);
  void solveContacts(double dt, double gravity, bool first);

  std::vector<Solid> solids_;
  Walls walls_;
  double spacing_;
  double separationSpeed_, lastStep_ = 0;
  Surface surface_;  // while predict() runs
  std::vector<int> indexOf_;
  std::vector<RigidBody> bodies_;
  std::vector<Pose> poses_;  // of all solids in the substep
  double fastest_ = 0;
  bool atRest_ = false;    // of the last prediction
  bool advanced_ = false;  // the last prediction was ended in time
};

}  // namespace rill::reference
