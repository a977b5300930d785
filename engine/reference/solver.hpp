#pragma once
// Reference implementation of Position Based Fluids (Macklin and Mueller 2013) with walls, solids and an integral warm start, in double
// precision on one thread. It documents the method and is the oracle of the shaders' tests; readability comes before speed.
//
// A substep of dt. Notation: K = d^3 W as in sph/kernel.hpp, G_ij = grad_i K(x*_i - x*_j); sums over j are over neighbors and, but for
// vorticity, over their images behind walls and the particle's own (reference/images.hpp), which move as in a mirror; B_i = density
// contribution of solids, grad B_i its gradient, a_i = tangential scale, a symmetric matrix: solidScale() in
// sph/solid_scale.hpp, a_ij = 1 + s (a_i - 1) + s (a_j - 1).
//   density       rho_i/rho0 = K(0) + sum_j K_ij + B_i,   C_i = rho_i/rho0 - 1,
//                 D_i = m_i^-1 g . a_i g + tr(a_i) / 3 sum_j m_j^-1 |G_ij|^2 + m_i^-1 eps D_rest with g = sum_j G_ij + grad B_i
//   multipliers   delta_i = -omega C_i / D_i,   lambda_i = min(0, lambda_i + delta_i), initially w_i; its change is dlambda_i.
//                 In the first iteration w_i = min(0, w_i + kappa delta_i): an integral that keeps the pressure of a fluid at rest from
//                 substep to substep (warm start)
//   correction    x*_i += m_i^-1 (sum_j a_ij (dlambda_i + dlambda_j + s_ij) G_ij + dlambda_i grad B_i), then projected out of solids
//                 and walls
//   velocities    v = (x* - x) / dt, contact with solids, |v| <= the limit, x = x*
//   viscosity     an implicit step, and noise damping of slow fluid;  diffusion   of concentrations;  vorticity   confinement
//   drag          linear;  tension   of the surface
//   predict       w_i *= (dt_next/dt)^2,
//                 x*_i = x_i + dt_next (v_i + g dt_next) + m_i^-1 (sum_j a_ij (w_i + w_j) G_ij + w_i grad B_i), then projected out of
//                 solids and walls
// m_i is the particle's mass over that of one of the densest fluid. Density counts particles, whatever their mass (Solenthaler and Pajarola
// 2008). Density to correction repeat for every iteration. The pairs of the last density evaluation (neighbors, K_ij and G_ij) are used by
// all stages up to the next one.
#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "reference/bodies.hpp"
#include "reference/images.hpp"
#include "reference/settings.hpp"
#include "rill/scene.hpp"
#include "shape/pose.hpp"
#include "sph/artificial_pressure.hpp"
#include "sph/half_space.hpp"
#include "sph/kernel.hpp"
#include "sph/mesh_field.hpp"
#include "sph/no_slip.hpp"
#include "sph/solid_density.hpp"
#include "sph/solid_scale.hpp"

namespace rill::reference {

/// Pairs closer than kCoincidentDistance h are coincident. Their direction comes from a hash of their ids (shaders/shared/pair_hash.h), the
/// length of the gradient from distance kCoincidentGradient h, and each correction separates them by kCoincidentDistance h each.
inline constexpr double kCoincidentDistance = 1e-3, kCoincidentGradient = 0.05;

/// A particle is in contact with a solid if its center is within this many spacings of the surface; centers are kept at 0.5.
inline constexpr double kContactDistance = 0.55;

/// s of a_ij = 1 + s (a_i - 1) + s (a_j - 1); see docs/notes/walls-and-solids.md.
inline constexpr double kScaleOfPair = 0.4;

/// Lower limit of D_i over D_rest, which avoids division by zero for isolated particles with eps = 0.
inline constexpr double kMinDenominator = 1e-6;

/// What a substep does in turn. Pressure is Density, Multipliers and Correction, for every iteration.
enum class Stage {
  Density,
  Multipliers,
  Correction,
  Velocities,
  Viscosity,
  NoiseDamping,
  Diffusion,
  Vorticity,
  Drag,
  SurfaceTension,
  Prediction
};

class ReferenceSolver {
 public:
  /// A neighbor j of particle i in the last density evaluation, or its image behind a wall (of i itself, too).
  struct Pair {
    uint32_t j = 0;
    glm::dvec3 offset = {0, 0, 0};    ///< x_i - x_j, of the image of j; m
    glm::dvec3 sign = {1, 1, 1};      ///< of the image: -1 along the normals of the walls that it is behind
    double value = 0;                 ///< K_ij
    glm::dvec3 gradient = {0, 0, 0};  ///< G_ij, 1/m
    glm::dvec3 apart = {0, 0, 0};     ///< unit direction from j to i of a coincident pair; else 0
  };

  /// State that is carried from substep to substep. It may be set between stages.
  struct State {
    std::vector<glm::dvec3> position;   ///< x, m, at time()
    std::vector<glm::dvec3> velocity;   ///< v, m/s
    std::vector<glm::dvec3> predicted;  ///< x*, m, at the end of the substep
    std::vector<double> warm;           ///< w, m^2, <= 0
    std::vector<uint32_t> id;           ///< unique
    std::vector<uint8_t> fluid;         ///< index into settings.fluids
    /// Of each fluid that diffuses, its share in each particle. begin() makes it where it is empty.
    std::vector<std::vector<double>> concentration;
  };

  /// Particles without warm start (w = 0), with ids 0, 1, ... and x* = x. Empty `velocities`: all 0.
  ReferenceSolver(const ReferenceSettings& settings, std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities = {});

  /// Predicts the first substep of `dt` (s, > 0), from the pressure of solveInitialPressure() if it was called. Deactivates non-finite
  /// particles: positions become the lower corner (0 on open sides), velocities 0.
  void begin(double dt);

  /// Solves for the initial hydrostatic pressure, w for a step of `dt` (s, > 0). Call before begin(), with finite particles. Jacobi
  /// iterations with heavy-ball momentum (Polyak 1964) at fixed positions: x*_i = x_i + g dt^2 + sum_j a_ij (w_i + w_j) G_ij + w_i grad
  /// B_i, projected out of solids and walls, then w_i = min(0, min(0, w_i + momentum * previous change of w_i) + delta_i).
  void solveInitialPressure(double dt, double momentum, int iterations);

  /// Runs a substep of `dt`, the `dtNext` of the previous call or the `dt` of begin(), and predicts one of `dtNext`. s, > 0.
  void substep(double dt, double dtNext);

  /// The next substep is the first of its block, as that of an advance is.
  void startBlock() { substepsOfBlock_ = 0; }

  /// The stages of a substep in order. Each uses `state` and the results of earlier stages.
  void density();                           ///< neighbors of x*, pairs, rho, B, D
  void multipliers(bool firstIteration);    ///< lambda, dlambda; w in the first iteration
  void correction(double dt, double push);  ///< x*; `push`: artificial pressure times D_rest
  void velocities(double dt);               ///< v, x; adds dt to time()
  void viscosity(double dt);                ///< v: v' = v + dt f(v'), f the force of sph/viscosity.hpp; then noSlip()
  /// v: v -= c L(w L v), (L v)_i = sum_j K_ij (v_j - v_i), c of viscosityAtRest and `blockTime`, w of sparedFlow; and the coherence of v.
  void dampNoise(double dt, double blockTime);
  void diffuse(double dt);  ///< state.concentration: dc/dt of sph/diffusion.hpp
  /// Vorticity confinement (Macklin and Mueller 2013, eq. 15 and 16, with a dimensionless coefficient):
  ///   v += dt eps_v h |omega| (N x omega), omega_i = sum_j G_ij x (v_j - v_i), eta_i = sum_j G_ij (|omega_j| - |omega_i|),
  ///   N = eta / (|eta| + 0.001 |omega| / h).
  void vorticity(double dt);
  void surfaceTension(double dt);          ///< v, bodies: sph/surface_tension.hpp, at the positions x
  double surfaceEnergy() const;            ///< its energy, J
  void drag(double dt);                    ///< v: dv/dt = -drag v
  void predict(double dt, double dtNext);  ///< w, x*

  /// Impulses of the fluid on the solids in the last substep, about their centers; gravity on a solid is not included. They are the
  /// reaction to displacements of particles (density, collisions, contact) and to forces (no slip, surface tension).
  std::span<const Impulse> impulses() const { return impulses_; }
  const Bodies& bodies() const { return bodies_; }  ///< the solids that are rigid bodies

  /// Called by substep() after each of its stages; empty: not called.
  std::function<void(Stage)> onStage;

  State state;
  ReferenceSettings settings;  ///< gravity, coefficients and solids may change between substeps; kernel, spacing and walls may not

  size_t size() const { return state.position.size(); }
  double time() const { return time_; }                          ///< s, since begin
  uint32_t viscosityCapped() const { return viscosityCapped_; }  ///< particles that asked for more viscosity than viscosity() reached
  const SmoothingKernel& kernel() const { return kernel_; }
  double mass() const;                             ///< of a particle of the densest fluid: rho0 d^3, kg
  double inverseMass(size_t i) const;              ///< of a particle, over that of one of the densest fluid
  uint64_t inactive() const { return inactive_; }  ///< number of deactivations of non-finite particles

  /// Neighbors of particle i, then images.
  std::span<const Pair> pairs(size_t i) const { return std::span(pairs_).subspan(first_[i], first_[i + 1] - first_[i]); }
  glm::dvec3 ownGradient(size_t i) const;  ///< beside its pairs, what a particle's displacement is of its multiplier, 1/m
  std::span<const Pair> neighbors(size_t i) const { return pairs(i).first(neighborCount_[i]); }
  std::span<const double> densityRatio() const { return densityRatio_; }  ///< rho/rho0
  std::span<const double> lambda() const { return lambda_; }              ///< m^2, <= 0
  std::span<const double> lambdaChange() const { return lambdaChange_; }  ///< dlambda, m^2
  double shearRate(size_t i, const std::vector<glm::dvec3>& v) const;     ///< of particle i in its fluid, 1/s: sqrt(2 D : D)
  std::span<const glm::dvec3> curl() const { return curl_; }              ///< of v, 1/s, of the last vorticity()

  /// B and grad B at a point, with solids at time `t` (s).
  SolidSample boundaryAt(const glm::dvec3& x, double t) const;
  /// s_corr (eq. 13) of a pair with kernel value `value`, m^2, <= 0; `push` as in correction(). See sph/artificial_pressure.hpp.
  double artificialPressureTerm(double value, double push) const;
  double artificialPressurePush() const { return push_; }  ///< `push` of the last correction(), m^2
  /// Coefficient c of XSPH for a substep, dimensionless: 2 mu dt / (rho0 sigma^2).
  double xsphCoefficient(double viscosity, double dt) const;

 private:
  /// Is called with a displacement of a particle by a solid, and the point that the reaction acts at.
  using AddReaction = std::function<void(size_t solid, const glm::dvec3& displacement, const glm::dvec3& at)>;
  glm::dvec3 collide(glm::dvec3 x, std::span<const Pose> poses, const AddReaction& add = {}, bool withBodies = true) const;
  /// Turns pushes of a particle that has been in contact with its nearest solid into pushes along the normal at the substep's start.
  void moveAlongSurface(size_t i, std::span<const Pose> poses, std::span<const Pose> before, const AddReaction& add);
  glm::dvec3 contact(size_t i, glm::dvec3 v, double dt, std::span<const Pose> poses, const AddReaction& add) const;
  void addReactions(size_t i, double multiplier, std::span<const Pose> poses, const AddReaction& add) const;  ///< multiplier times grad B_i
  /// Adds what it is called with times `factor` and the mass of a particle of the densest fluid, reversed.
  AddReaction addTo(std::vector<Impulse>& impulses, std::span<const Pose> poses, double factor) const;
  std::vector<Pose> poses(double t, double dt) const;  ///< of bodies: where they are predicted to be, else where they are
  void addContributions(double dt, std::span<const double> kept);
  void moveBodies(double dt);  ///< by the reaction since the last call
  SolidSample boundaryOf(const glm::dvec3& x, std::span<const Pose> poses, double t) const;
  void addMouths(const glm::dvec3& x, double t, SolidSample& sample) const;
  void keepMouthsFree(double dt);
  double emitterSpeed() const;  ///< m/s, of the fastest mouth that is open or may open in the advance
  /// Calls visit(solid, sample, image) with what each solid displaces at each image of x, in the scene's frame and not reflected.
  void forEachSample(const glm::dvec3& x, std::span<const Pose> poses,
                     const std::function<void(size_t, const SolidSample&, const Image&)>& visit) const;
  SolidSample displacedBy(size_t solid, const Double3& local) const;                  ///< in the solid's frame
  SurfacePoint surfaceOf(size_t solid, const Pose& pose, const glm::dvec3& x) const;  ///< of a mesh from its field
  glm::dmat3 tangentialScale(size_t i) const;                                         ///< a_i
  glm::dmat3 pairScale(size_t i, const Pair& pair) const;                             ///< a_ij
  Pair makePair(uint32_t i, uint32_t j) const;
  void addImages(uint32_t i, std::span<const uint32_t> neighbors);
  void predictPositions(double dt, bool atRest);
  /// The part of a displacement by solids that counts as speed: what stops a displacement `moved` toward them, and `most`, m.
  static double keptPush(const glm::dvec3& moved, const glm::dvec3& push, double most);
  void deactivate(size_t i);
  void addSpeed(double speed);
  void updateRestFactor();
  void planBlock(double dt, double dtNext);
  /// sum_j pairWeight (c_j - c_i)
  std::vector<double> exchange(const std::vector<double>& c) const;
  double diffusionRow() const;  ///< the largest sum over j of pairWeight
  /// A point at a particle that is not covered.
  struct SurfaceSample {
    uint32_t particle;
    glm::dvec3 offset;       ///< of the point, m
    double open;             ///< 1 - c
    double weight;           ///< w
    glm::dvec3 weightSlope;  ///< its gradient, times the spacing
    size_t solid;            ///< that w is of
  };
  std::vector<SurfaceSample> surfaceSamples() const;
  double tensionOf(size_t i) const;                                                ///< N/m
  double coverOf(size_t i, size_t j) const;                                        ///< m, of samples of i by j
  double pairViscosity(size_t i, size_t j) const;                                  ///< over settings.viscosity: the harmonic mean
  std::vector<double> shearViscosities(double c);                                  ///< of particles, likewise, from the rates of shear
  double densityScale() const;                                                     ///< factor on the fluid's part of the density
  std::vector<glm::dvec3> meanDifference(const std::vector<glm::dvec3>& v) const;  ///< sum_j K_ij (v_j - v_i)
  std::vector<glm::dvec3> viscousForce(double c,
                                       const std::vector<glm::dvec3>& v) const;  ///< c m_i^-1 sum_j mu_ij / mu w q (q . (v_j - v_i))
  double viscosityBound(double c, std::span<const double> held) const;           ///< as the shaders bound eigenvalues; held: by solids
  /// How a solid holds a particle of viscous fluid; see docs/notes/slip.md.
  struct Adhesion {
    size_t particle, solid;
    double strength;     ///< a_k
    glm::dvec3 at;       ///< m, the particle's image
    glm::dvec3 reverse;  ///< factors of its velocity there
  };
  std::vector<Adhesion> adhesions(std::span<const Pose> poses, double c, bool ofBodies) const;  ///< by particle
  void noSlip(double c, double dt);                                ///< v, bodies: with the factor c of the force
  void add(double factor, const std::vector<glm::dvec3>& change);  ///< to the velocities

  SmoothingKernel kernel_;
  double liquidScale_;
  ArtificialPressure artificial_;
  Walls walls_;
  HalfSpaceTable halfSpace_;
  std::vector<float> noSlipTable_;
  std::vector<SphereTable> sphereTables_;             ///< one per solid; empty but for spheres
  std::vector<std::optional<MeshField>> meshFields_;  ///< one per solid; of meshes
  double time_ = 0;
  double step_ = 0;                 ///< s; state.predicted is at time_ + step_
  double initialPressureStep_ = 0;  ///< s, `dt` of solveInitialPressure(); 0: not called
  uint64_t inactive_ = 0;
  std::vector<uint32_t> first_, neighborCount_;
  std::vector<Pair> pairs_;
  std::vector<glm::dmat3> scale_;  ///< a_i; empty without solids
  std::vector<double> densityRatio_, denominator_, delta_, lambda_, lambdaChange_;
  std::vector<double> lastChange_;  ///< lambdaChange_ of the substep before, in the terms of this one, m^2
  bool blockStart_ = true;          ///< the substep is the first of its block
  std::vector<SolidSample> boundary_;
  std::vector<glm::dvec3> boundaryPlace_;  ///< m, that it is of
  Bodies bodies_;
  std::vector<Pose> densityPoses_;                  ///< that the density is of
  std::vector<Impulse> impulses_, warmImpulses_;    ///< of the present substep; of the prediction of the next one
  std::vector<Impulse> applied_;                    ///< of impulses_, what has moved bodies
  std::vector<glm::dvec3> rejected_;                ///< m, the part of pushes by bodies in the last correction that changes no velocity
  std::vector<glm::dvec3> rejectedBefore_;          ///< of corrections before it, in the present substep
  std::vector<double> predictionPush_, pushedOut_;  ///< m, what solids pushed the prediction, and after the last correction
  std::vector<bool> gaveWay_;                       ///< whether a body that did pushed the particle in the last correction
  bool firstIteration_ = true;
  /// A displacement in the last correction, m, before gains are bounded.
  struct Contribution {
    size_t particle, solid;
    glm::dvec3 displacement, at;
  };
  std::vector<Contribution> contributions_;
  std::vector<glm::dvec3> curl_;
  std::vector<glm::dvec3> prior_;         ///< m/s, velocities before the substep, if shear changes viscosities
  std::vector<double> shearViscosity_;    ///< over settings.viscosity, of particles
  uint32_t viscosityCapped_ = 0;          ///< of them, those that the solve does not reach
  double blockTime_ = 0;                  ///< s, since the first substep of the last block
  double push_ = 0;                       ///< m^2, of the last correction
  int substepsOfBlock_ = 0;               ///< of the present block, before the present substep
  double travel_ = 0;                     ///< m, of the fastest particle since the device built its neighbor list
  double restFactor_ = 0;                 ///< 1: at rest, 0: at motionSpeed or faster
  double fastest_ = 0;                    ///< largest speed, m/s, initially or in the last velocities()
  double squares_ = 0;                    ///< sum of the squares of speeds, m^2/s^2, likewise
  std::vector<glm::dvec3> wallPosition_;  ///< m, position after the last correction and the walls, before solids
  std::vector<glm::dvec3> planned_;       ///< m, displacement of the prediction before walls and solids
  std::vector<double> coherence_;         ///< of the motion, found with noise damping; 0 before that in a block
  std::vector<double> backgroundShare_;   ///< of its own pressure that a particle does not feel: see sph/background_pressure.hpp
  std::vector<glm::dvec3> gain_;          ///< m, displacement by the last correction and the walls
};

}  // namespace rill::reference
