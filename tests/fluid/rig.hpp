#pragma once
// The solver on the device beside the reference: both made from one scene, particles compared by id, in units of the spacing.
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fluid/fluid_impl.hpp"
#include "fluid/trial.hpp"
#include "gpu/device_impl.hpp"
#include "reference/solver.hpp"
#include "rill/fluid.hpp"
#include "rill/snapshot.hpp"
#include "support/gpu_test.hpp"

namespace rill::test {

/// Particles in the order of their ids.
struct Snapshot {
  std::vector<glm::dvec3> x, v;
  std::vector<double> density;                 ///< over the rest density; 0 unless figures were asked for
  std::vector<glm::dvec4> concentration = {};  ///< empty unless fluids diffuse
  friend bool operator==(const Snapshot&, const Snapshot&) = default;
  bool finite() const;
  glm::dvec3 velocitySum() const;
  double fastest() const;  ///< m/s
};

/// The reference of a trial, before its first substep.
class Oracle {
 public:
  explicit Oracle(const Trial& trial);
  /// An advance of some substeps of the trial's step, with the scene's changes of gravity.
  void advance(int substeps);
  /// The same; returns what each solid got.
  std::vector<reference::Impulse> advanceWithLoads(int substeps);
  reference::ReferenceSolver& solver() { return solver_; }

 private:
  void substep();
  const Trial& trial_;
  reference::ReferenceSolver solver_;
};

/// Largest difference over all particles, in units of the spacing; the velocity's is over a step's time.
struct Difference {
  double position = 0, velocity = 0;
  size_t worst = 0;
};

/// The first field of a state that differs, with how many values of it and the first one; empty if the states are equal.
std::string firstDifference(const FluidSnapshot& a, const FluidSnapshot& b);

class FluidTest : public GpuTest {
 protected:
  /// One fluid with the graph that runs it.
  class Run {
   public:
    /// `from`: goes on from it.
    Run(FluidTest& test, const Trial& trial, const FluidSnapshot* from = nullptr);
    /// What the next graph reads of transient memory before anyone wrote it. At the start that is NaN.
    void fillTransients(uint32_t word);
    /// Goes on until the advance is complete, in pieces of `piece` substeps recorded.
    void advance(double seconds, uint32_t piece = 64);
    void substeps(int count, uint32_t piece = 64) { advance(count * step_, piece); }
    Snapshot snapshot();
    Snapshot read(const FluidStep& step);                     ///< the particles after one graph of it
    FluidSnapshot saved();                                    ///< the state, as a checkpoint has it
    FluidStats stats();                                       ///< of the present instant
    const Snapshot& measured() const { return measured_; }    ///< the particles that stats() saw
    const FluidControl& control() const { return control_; }  ///< what the device had decided at the end of the last read
    const FluidProgress& progress() const { return fluid_->progress(); }
    Fluid& fluid() { return *fluid_; }

    std::vector<SolidTarget> targets;     ///< of the next advances
    std::vector<BodyPull> pulls;          ///< likewise
    std::vector<EmitterTarget> emitters;  ///< of the next advance alone

   private:
    FluidTest& test_;
    double step_;
    Graph graph_;
    Snapshot measured_;
    FluidControl control_{};
    std::optional<Fluid> fluid_;
  };

  std::unique_ptr<Run> start(const Trial& trial, const FluidSnapshot* from = nullptr) { return std::make_unique<Run>(*this, trial, from); }
  void runGraph(Graph& graph) { run(graph); }
  void runGraphs(std::span<Graph* const> graphs) { run(graphs); }
  Device& rillDevice() { return device(); }

  /// Buffers are of at most `bytes` while it lives: a long list is then split over several, on any device.
  class SmallBuffers {
   public:
    SmallBuffers(FluidTest& test, uint64_t bytes) : info_(implOf(test.rillDevice()).info), before_(info_.maxBufferBytes) {
      info_.maxBufferBytes = bytes;
    }
    ~SmallBuffers() { info_.maxBufferBytes = before_; }
    SmallBuffers(const SmallBuffers&) = delete;
    SmallBuffers& operator=(const SmallBuffers&) = delete;

   private:
    DeviceInfo& info_;
    uint64_t before_;
  };

  /// Calls check() with a run of the trial after `substeps`, for each of gathersInTurn().
  void forEachGather(Trial trial, int substeps, const std::function<void(Run&)>& check);
  /// After `substeps`; `exact` has made as many.
  Difference difference(const Trial& trial, int substeps, Oracle& exact);
  /// For each of gathersInTurn(): none above the limits (spacings). `ageing` is added for the list, in which pairs that have come
  /// nearer by more than its skin since it was built are missing: fragments that fly apart at several spacings in ten substeps.
  void expectEqual(Trial trial, int substeps, double position, double velocity, double ageing = 0);
};

}  // namespace rill::test
