// The passes of one substep: walls, density, correction, contact, and the terms that a scene has. See docs/method.md.
#include "fluid/pass_parts.hpp"

namespace rill {

void FluidImpl::declareSubstep(Graph& graph, uint32_t parity, bool first) {
  const FluidParams& p = setup.params;
  const std::span<const Chunk> chunks(chunks_);
  const Use read = readUse(texel_);
  const bool calms = first && p.noiseDampingRate > 0;
  ++recording_.substeps;
  if (first) ++recording_.blocks;
  if (setup.movingSolids) {
    graph.pass("move solids", [&](Pass& pass) {
      readSwitched(pass, r_);
      pass.read(r_.keyframes, Use::ComputeRead);
      r_.solids = pass.write(r_.solids, Use::ComputeWrite);
      const Kernel kernel = pass.kernel(pipes_.pose, {r_.params, r_.control, r_.solids, r_.keyframes});
      return [=, arguments = r_.commands](Commands& commands) { commands.dispatchIndirect(kernel, arguments, commandAt(kCommandPose)); };
    });
  }
  for (uint32_t iteration = 0; iteration < p.iterations; ++iteration) {
    const bool again = iteration > 0;
    if (again) {
      gatherPass(graph, r_, read, chunks, "iterate", pipes_.iterate, r_.work, kCommandIterate, ChunkPush{0, 0, iteration},
                 [&](Pass& pass, BindingList& bindings) {
                   pass.read(r_.nearSample, read);
                   r_.prediction = pass.write(r_.prediction, Use::ComputeWrite);
                   bindings.add({r_.prediction, r_.nearSample});
                 });
    }
    if (setup.near) {
      wallPass(graph, r_, read, "walls and solids", pipes_.walls, r_.prediction, again ? kCommandPlaneAgain : kCommandPlane,
               again ? kCommandCornerAgain : kCommandCorner);
    }
    gatherPass(graph, r_, read, chunks, "density", pipes_.density, r_.prediction, again ? kCommandIterate : kCommandDensity,
               ChunkPush{0, 0, iteration}, [&](Pass& pass, BindingList& bindings) {
                 pass.read(r_.nearSample, read);
                 for (BufferRef* ref : {&r_.warm, &r_.work, &r_.multiplier}) *ref = pass.write(*ref, Use::ComputeWrite);
                 bindings.add({r_.warm, r_.work, r_.nearSample, r_.multiplier});
               });
    graph.pass("control", [&](Pass& pass) {
      pass.read(r_.params, Use::ComputeUniform);
      pass.read(r_.shapes, Use::ComputeRead);
      pass.read(r_.gravity, Use::ComputeRead);
      r_.control = pass.write(r_.control, Use::ComputeWrite);
      r_.sums = pass.write(r_.sums, Use::ComputeWrite);
      r_.commands = pass.write(r_.commands, Use::ComputeWrite);
      const Kernel kernel = pass.kernel(pipes_.control, {r_.params, r_.control, r_.sums, r_.shapes, r_.commands, r_.gravity});
      const ControlPush push{iteration, parity, commandCount(), first};
      return [=](Commands& commands) { commands.dispatch(kernel, 1, push); };
    });
  }
  BufferRef free = p.solidCount > 0 ? graph.create("free velocities", {uint64_t{count} * 16}) : BufferRef{};
  const GatherPipelines& correct = first && p.tensileRate > 0 ? pipes_.correctWithArtificialPressure : pipes_.correct;
  gatherPass(
      graph, r_, read, chunks, "correct", correct, r_.work, kCommandCorrect + parity, ChunkPush{}, [&](Pass& pass, BindingList& bindings) {
        pass.read(r_.nearSample, read);
        for (BufferRef* ref : {&r_.position, &r_.velocity, &r_.prediction, &r_.warmAcceleration, &r_.warm})
          *ref = pass.write(*ref, Use::ComputeWrite);
        if (p.solidCount > 0) free = pass.write(free, Use::ComputeWrite, true);
        bindings.add(
            {r_.position, r_.velocity, r_.nearSample, r_.prediction, r_.warmAcceleration, p.solidCount > 0 ? free : r_.velocity, r_.warm});
      });
  if (p.solidCount > 0) declareCollide(graph, "collide", pipes_.collide, free, parity);
  declareTerms(graph, parity, calms);
  // Those have predicted anew, with walls but without solids.
  if (p.solidCount > 0 && (setup.viscositySweeps > 0 || calms || p.vorticity > 0))
    declareCollide(graph, "predict after terms", pipes_.predictAfterTerms, free, parity);
}

void FluidImpl::declareCollide(Graph& graph, std::string_view name, const ComputePipeline* pipeline, BufferRef free, uint32_t parity) {
  graph.pass(name, [&](Pass& pass) {
    readSwitched(pass, r_);
    for (BufferRef ref : {r_.warmAcceleration, r_.nearList, r_.sums, r_.solids, free, r_.work, r_.warm, r_.nearSample})
      pass.read(ref, Use::ComputeRead);
    for (BufferRef* ref : {&r_.position, &r_.velocity, &r_.prediction}) *ref = pass.write(*ref, Use::ComputeWrite);
    const Kernel kernel = pass.kernel(pipeline, {r_.params, r_.control, r_.position, r_.velocity, r_.prediction, r_.warmAcceleration,
                                                 r_.nearList, r_.sums, r_.solids, free, r_.work, r_.warm, r_.nearSample});
    return [=, arguments = r_.commands](Commands& commands) {
      commands.dispatchIndirect(kernel, arguments, commandAt(kCommandCollide + parity));
    };
  });
}

// Sweeps of XSPH, there and back between the velocities and a copy.
void FluidImpl::declareSweeps(Graph& graph, std::string_view name, uint32_t sweeps, uint32_t command, float share) {
  const Use read = readUse(texel_);
  BufferRef from = r_.velocity;
  BufferRef other = graph.create("smoothed velocities", {(uint64_t{count} + 1) * 16});
  for (uint32_t sweep = 0; sweep < sweeps; ++sweep) {
    BufferRef to;
    gatherPass(graph, r_, read, chunks_, name, pipes_.viscosity, r_.work, command, SweepPush{0, 0, share},
               [&](Pass& pass, BindingList& bindings) {
                 pass.read(from, read);
                 pass.read(r_.warmAcceleration, read);
                 to = pass.write(other, Use::ComputeWrite, true);
                 r_.prediction = pass.write(r_.prediction, Use::ComputeWrite);
                 pass.read(r_.position, read);
                 bindings.add({from, to, r_.prediction, r_.warmAcceleration, r_.position});
               });
    other = from;
    from = to;
  }
  r_.velocity = sweeps % 2 == 0 ? from : other;
  if (sweeps % 2 == 0) return;
  graph.pass("copy velocities", [&](Pass& pass) {
    readSwitched(pass, r_);
    pass.read(from, Use::ComputeRead);
    r_.velocity = pass.write(r_.velocity, Use::ComputeWrite);
    const Kernel kernel = pass.kernel(pipes_.copyVelocity, {r_.params, r_.control, from, r_.velocity});
    return [=, arguments = r_.commands, chunks = std::span<const Chunk>(chunks_)](Commands& commands) {
      for (const Chunk& c : chunks)
        for (uint32_t either : {command, walkingCommand(command)})
          commands.dispatchIndirect(kernel, arguments, commandAt(either), ChunkPush{c.first, c.last, 0});
    };
  });
}

// Viscosity, damping of noise and vorticity confinement, where the scene has them.
void FluidImpl::declareTerms(Graph& graph, uint32_t parity, bool calms) {
  const std::span<const Chunk> chunks(chunks_);
  const Use read = readUse(texel_);
  const uint32_t command = kCommandCorrect + parity;
  const uint64_t bytes = (uint64_t{count} + 1) * 16;
  const uint32_t sweeps = setup.viscositySweeps;
  if (sweeps > 0) declareSweeps(graph, "viscosity", sweeps, command, 1.0f / float(sweeps));
  if (calms) declareSweeps(graph, "noise damping", 1, kCommandNoiseDamping, 0);
  if (setup.params.vorticity > 0) {
    BufferRef curl = graph.create("curl", {bytes});
    gatherPass(graph, r_, read, chunks, "curl", pipes_.curl, r_.work, command, ChunkPush{}, [&](Pass& pass, BindingList& bindings) {
      pass.read(r_.velocity, read);
      curl = pass.write(curl, Use::ComputeWrite, true);
      bindings.add({r_.velocity, curl});
    });
    gatherPass(graph, r_, read, chunks, "confine", pipes_.confine, r_.work, command, ChunkPush{}, [&](Pass& pass, BindingList& bindings) {
      pass.read(curl, read);
      pass.read(r_.warmAcceleration, read);
      r_.velocity = pass.write(r_.velocity, Use::ComputeWrite);
      r_.prediction = pass.write(r_.prediction, Use::ComputeWrite);
      pass.read(r_.position, read);
      bindings.add({curl, r_.velocity, r_.prediction, r_.warmAcceleration, r_.position});
    });
  }
}

}  // namespace rill
