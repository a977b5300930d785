#pragma once
// Position based fluids (Macklin and Mueller 2013) with walls, solids and an integral warm start, in double precision on one thread: the
// oracle of the shaders and the documentation of the method. Speed comes after readability.
//
// A substep of dt. Notation: K = d^3 W as in sph/kernel.hpp, G_ij = grad_i K(x*_i - x*_j), B_i = what walls and solids add to the density,
// grad B_i its gradient, a_i what makes up, axis by axis, for what is beside the particle: 1 / (1 - min(WallSample::beside, kMaxWallCoverage)).
//   density       rho_i/rho0 = K(0) + sum_j K_ij + B_i,   C_i = rho_i/rho0 - 1,
//                 D_i = g . a_i g + mean(a_i) sum_j |G_ij|^2 + eps D_rest with g = sum_j G_ij + grad B_i
//   multipliers   delta_i = -omega C_i / D_i,   lambda_i = min(0, lambda_i + delta_i), starting from w_i; the change is dlambda_i.
//                 In the first iteration w_i = min(0, w_i + kappa delta_i): a slow integral, so that a fluid at rest carries its pressure
//                 from substep to substep
//   correction    x*_i += a_i sum_j (dlambda_i + dlambda_j + s_ij) G_ij + dlambda_i grad B_i, then out of solids and walls
//   velocities    v = (x* - x) / dt, contact with solids, |v| <= the limit, x = x*
//   viscosity     XSPH, with more of it where the fluid is at rest;  vorticity   confinement
//   predict       w_i *= (dt_next/dt)^2,
//                 x*_i = x_i + dt_next (v_i + g dt_next) + a_i sum_j (w_i + w_j) G_ij + w_i grad B_i, then out of solids and walls
// Density to correction repeat for every iteration.
// The pairs of the last density evaluation (its neighbors, K_ij and G_ij) serve all stages up to the next one.
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "rill/scene.hpp"
#include "sph/artificial_pressure.hpp"
#include "sph/kernel.hpp"
#include "sph/solid_density.hpp"
#include "sph/solid_pose.hpp"
#include "sph/wall.hpp"

namespace rill::reference {

/// Pairs nearer than this share of h have no usable direction: they take one from their ids (shaders/shared/pair_hash.h), with the
/// gradient's length at `kCoincidentGradient` h, and each is moved `kCoincidentDistance` h along it in every correction, whatever its
/// density.
inline constexpr double kCoincidentDistance = 1e-3, kCoincidentGradient = 0.05;

/// A particle whose center is within this many spacings of a solid's surface touches it (0.5 is where centers are held).
inline constexpr double kContactDistance = 0.55;

/// D_i is at least this share of D_rest, so that eps = 0 does not divide a lone particle by 0.
inline constexpr double kLeastDenominator = 1e-6;

/// Every coefficient, explicit. Nothing is "auto" here.
struct ReferenceSettings {
  KernelChoice kernel = KernelChoice::Wendland;
  double spacing = 0.05;               ///< d, m, > 0
  double smoothingRatio = 2;           ///< h / d, 1.2 .. 4
  double density = 1000;               ///< rho0, kg/m^3, > 0
  glm::dvec3 gravity = {0, -9.81, 0};  ///< m/s^2

  glm::dvec3 lo = glm::dvec3(-std::numeric_limits<double>::infinity());  ///< m, walls; -infinity: open
  glm::dvec3 hi = glm::dvec3(std::numeric_limits<double>::infinity());   ///< m, walls; infinity: open
  glm::dvec3 origin = {0, 0, 0};  ///< m, where the positions' zero is in the scene: taken off the solids
  std::vector<Solid> solids;  ///< in scene coordinates; they should not overlap each other or the walls, since what they displace adds up
  bool tabulated = false;     ///< walls and solids from the tables that the shaders read, in place of the sums

  int iterations = 1;         ///< Jacobi iterations a substep, >= 1
  double relaxation = 0.5;    ///< omega, > 0 .. 2; 0.5 is quiet in a still tank
  double regularization = 0;  ///< eps, a fraction of D_rest, >= 0
  double warmStart = 0.01;    ///< kappa, 0 .. 0.5
  double warmRelease = 1.5;   ///< times kappa where density is below rest density

  double roughSpeed = 0;      ///< m/s of the fastest particle, at which omega and kappa are those above; 0: always
  double calmRelaxation = 0;  ///< omega of a fluid at rest, likewise; between them by the fourth power of the speed
  double calmWarmStart = 0;   ///< kappa of a fluid at rest
  double calmViscosity = 0;   ///< mu of a fluid at rest, Pa s, on top of `viscosity`; none at roughSpeed
  int substepsPerBlock = 1;   ///< substeps from one use of it, and of the artificial pressure, to the next

  double tensile = 0;           ///< strength of the artificial pressure, 0 .. 1: see sph/artificial_pressure.hpp
  double tensileRadius = 0.25;  ///< delta q / h
  double tensilePower = 16;     ///< n

  double viscosity = 0;                                         ///< mu, Pa s
  int viscositySweeps = 1;                                      ///< n: XSPH sweeps a substep, each with c/n, which has to be below 1
  double vorticity = 0;                                         ///< eps_v, dimensionless, 0 .. 1
  double speedLimit = std::numeric_limits<double>::infinity();  ///< m/s, of a particle after a substep
  double warmLimit = std::numeric_limits<double>::infinity();   ///< m^2/s^2: w is at least -warmLimit dt^2
  double pushLow =
      std::numeric_limits<double>::infinity();  ///< m/s: half of the fastest particle's speed, held between these, and 4 g dt on top,
  double pushHigh = std::numeric_limits<double>::infinity();  ///< is the most that the last correction may add to a particle's speed
};

class ReferenceSolver {
 public:
  /// A neighbor j of particle i, of the last density evaluation.
  struct Pair {
    uint32_t j = 0;
    double value = 0;                 ///< K_ij
    glm::dvec3 gradient = {0, 0, 0};  ///< G_ij, 1/m
    glm::dvec3 apart = {0, 0, 0};     ///< unit, from j to i, where the pair coincides; else 0
  };

  /// All that a substep carries to the next. Any part may be set between stages.
  struct State {
    std::vector<glm::dvec3> position;   ///< x, m, at time()
    std::vector<glm::dvec3> velocity;   ///< v, m/s
    std::vector<glm::dvec3> predicted;  ///< x*, m, at the end of the substep
    std::vector<double> warm;           ///< w, m^2, <= 0
    std::vector<uint32_t> id;           ///< unique
  };

  /// Particles at rest in the warm start's sense (w = 0), with ids 0, 1, ... and x* = x. `velocities` may be empty: all 0.
  ReferenceSolver(const ReferenceSettings& settings, std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities = {});

  /// The first prediction, for a first substep of `dt` (s, > 0), with the pressure that press() has found. What is not finite is parked
  /// here: a position at the lower corner (0 where open), a velocity at 0.
  void begin(double dt);

  /// Before begin(), of finite particles: the pressure that bears the start, w for a step of `dt` (s, > 0), by Jacobi iterations with
  /// heavy-ball momentum in which nothing moves: x*_i = x_i + g dt^2 + a_i sum_j (w_i + w_j) G_ij + w_i grad B_i, out of solids and
  /// walls, then w_i = min(0, min(0, w_i + momentum (w_i - w_i of the iteration before)) + delta_i).
  void press(double dt, double momentum, int iterations);

  /// One substep of `dt`, which is the `dtNext` of the call before (or begin's `dt`), with the prediction of one of `dtNext`. s, > 0.
  void substep(double dt, double dtNext);

  /// The substep's parts, in its order: each reads `state` and what the parts before it left.
  void density();                           ///< neighbors of x*, pairs, rho, B, D
  void multipliers(bool firstIteration);    ///< lambda, dlambda; w in the first iteration
  void correction(double dt, double push);  ///< x*; `push`: the artificial pressure, over 1 / D
  void velocities(double dt);               ///< v, x; time goes on by dt
  void viscosity(double dt);                ///< v: v_i += c/n sum_j K_ij (v_j - v_i), n times; symmetric, so it keeps momentum
  void calm(double dt);                     ///< v: the same once, with the viscosity that a fluid at rest has on top
  /// v += dt eps_v h |omega| (N x omega), with the curl omega_i = sum_j G_ij x (v_j - v_i), eta_i = sum_j G_ij (|omega_j| - |omega_i|) and
  /// N = eta / (|eta| + 0.001 |omega| / h). An acceleration needs eps_v h |omega|^2 for a dimensionless eps_v: a vortex is fed at the rate
  /// at which it turns, and slow water is left alone.
  void vorticity(double dt);
  void predict(double dt, double dtNext);  ///< w, x*

  State state;
  ReferenceSettings settings;  ///< gravity, coefficients and solids may change between substeps; kernel, spacing and walls may not

  size_t size() const { return state.position.size(); }
  double time() const { return time_; }  ///< s, since begin
  const SmoothingKernel& kernel() const { return kernel_; }
  double mass() const;                         ///< of a particle: rho0 d^3, kg
  uint64_t parked() const { return parked_; }  ///< particles that were not finite, counted each time

  std::span<const Pair> pairs(size_t i) const { return std::span(pairs_).subspan(first_[i], first_[i + 1] - first_[i]); }
  std::span<const double> densityRatio() const { return densityRatio_; }  ///< rho/rho0
  std::span<const double> lambda() const { return lambda_; }              ///< m^2, <= 0
  std::span<const double> lambdaChange() const { return lambdaChange_; }  ///< dlambda, m^2
  std::span<const glm::dvec3> curl() const { return curl_; }              ///< of v, 1/s, of the last vorticity()

  /// B and grad B at a point, with the solids where they are at `t` (s).
  WallSample boundaryAt(const glm::dvec3& x, double t) const;
  /// s_corr of a pair with the kernel's value `value`, m^2, <= 0, where the artificial pressure is `push` over 1 / D: see
  /// sph/artificial_pressure.hpp.
  double tensileTerm(double value, double push) const;
  /// c of XSPH over the whole substep, dimensionless: 2 mu dt / (rho0 sigma^2).
  double xsphCoefficient(double viscosity, double dt) const;

 private:
  glm::dvec3 collide(glm::dvec3 x, std::span<const SolidPose> poses) const;
  glm::dvec3 contact(size_t i, glm::dvec3 v, double dt, std::span<const SolidPose> poses) const;
  std::vector<SolidPose> poses(double t, double dt) const;
  WallSample boundaryOf(const glm::dvec3& x, std::span<const SolidPose> poses) const;
  glm::dvec3 alongWalls(size_t i) const;  ///< a_i
  Pair makePair(uint32_t i, uint32_t j) const;
  void plan(double dt, bool still);
  void park(size_t i);
  void judgeCalmness();
  void smooth(double coefficient);

  SmoothingKernel kernel_;
  ArtificialPressure artificial_;
  WallTables tables_;
  std::vector<SphereTable> sphereTables_;  ///< as settings.solids; unused for boxes
  double time_ = 0;
  double step_ = 0;     ///< s: state.predicted is for time_ + step_
  double pressed_ = 0;  ///< s, the step of press(); 0: not called
  uint64_t parked_ = 0;
  std::vector<uint32_t> first_;
  std::vector<Pair> pairs_;
  std::vector<double> densityRatio_, denominator_, delta_, lambda_, lambdaChange_;
  std::vector<WallSample> boundary_;
  std::vector<glm::dvec3> curl_;
  double blockTime_ = 0;            ///< s since the last substep that was the first of its block
  int substeps_ = 0;                ///< since the start
  double calmness_ = 0;             ///< 1: at rest, 0: at roughSpeed or faster
  double fastest_ = 0;              ///< m/s, at the start or in the last velocities()
  std::vector<glm::dvec3> walled_;  ///< m, where the last correction put a particle, walls included, solids not
  std::vector<glm::dvec3> gained_;  ///< m, what the last correction moved a particle by, walls included
};

}  // namespace rill::reference
