// Pairs of neighbors, the density constraint, and the multipliers that it needs.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "reference/neighbors.hpp"
#include "reference/solver.hpp"
#include "shared/fluid_records.h"
#include "shared/pair_hash.h"

namespace rill::reference {
namespace {

/// The part of a multiplier's last change, m^2, that momentum acts on. `stiffness`: compression that a change of 1 m^2 ends, 1/m^2.
double momentumPart(double change, double stiffness) {
  const double ended = change * stiffness / kMomentumCompression, squared = ended * ended;
  return squared / (1 + squared) * change;
}

}  // namespace

ReferenceSolver::Pair ReferenceSolver::makePair(uint32_t i, uint32_t j) const {
  const glm::dvec3 r = state.predicted[i] - state.predicted[j];
  const double length = glm::length(r), h = kernel_.h();
  Pair pair{.j = j, .offset = r, .value = kernel_.value(length)};
  if (length >= kCoincidentDistance * h) {
    pair.gradient = kernel_.gradientOverR(length) * r;
  } else {
    const uint32_t a = state.id[i], b = state.id[j];
    pair.apart = glm::normalize(glm::dvec3(shared::pairDirection(a, b, 0), shared::pairDirection(a, b, 1), shared::pairDirection(a, b, 2)));
    pair.gradient = kernel_.gradientOverR(kCoincidentGradient * h) * kCoincidentGradient * h * pair.apart;
  }
  return pair;
}

double ReferenceSolver::densityScale() const {
  return settings.meltingTime > 0 ? std::lerp(1.0, liquidScale_, std::min(time_ / settings.meltingTime, 1.0)) : 1;
}

void ReferenceSolver::density() {
  const Neighbors found = findNeighbors(state.predicted, kernel_.h());
  const std::vector<Pose> solids = poses(time_, step_);
  first_.assign(1, 0);
  neighborCount_.resize(size());
  pairs_.clear();
  densityRatio_.resize(size());
  denominator_.resize(size());
  boundary_.resize(size());
  boundaryPlace_ = state.predicted;
  densityPoses_ = solids;
  if (firstIteration_) bodies_.beginStiffness();
  if (!settings.solids.empty()) scale_.resize(size());
  const double rest = kernel_.restGradientSum(), scale = densityScale();
  for (uint32_t i = 0; i < size(); ++i) {
    boundary_[i] = boundaryOf(state.predicted[i], solids, time_ + step_);
    double ratio = kernel_.value(0), squares = 0;
    const double own = inverseMass(i);
    glm::dvec3 sum = vec(boundary_[i].gradient);
    for (const uint32_t j : found.of(i)) pairs_.push_back(makePair(i, j));
    neighborCount_[i] = static_cast<uint32_t>(found.of(i).size());
    addImages(i, found.of(i));
    first_.push_back(static_cast<uint32_t>(pairs_.size()));
    for (const Pair& pair : pairs(i)) {
      ratio += pair.value;
      sum += pair.gradient;
      squares += inverseMass(pair.j) * glm::dot(pair.gradient, pair.gradient);
    }
    densityRatio_[i] = scale * ratio + boundary_[i].value;
    const glm::dmat3 tangential = tangentialScale(i);
    if (!scale_.empty()) scale_[i] = tangential;
    double all = own * glm::dot(sum, tangential * sum) + squares * (tangential[0].x + tangential[1].y + tangential[2].z) / 3;
    if (bodies_.any())
      forEachSample(state.predicted[i], solids, [&](size_t n, const SolidSample& displaced, const Image& image) {
        const double root = bodies_.root(n, image.of(state.predicted[i]), vec(displaced.gradient));
        all += root * bodies_.stiffness(n);
        if (firstIteration_) bodies_.addRoot(n, root, mass());
      });
    denominator_[i] = std::max(all + own * settings.regularization * rest, kMinDenominator * rest);
  }
}

void ReferenceSolver::multipliers(bool firstIteration) {
  const double omega = std::lerp(settings.relaxation, settings.relaxationAtRest, restFactor_),
               kappa = std::lerp(settings.warmStart, settings.warmStartAtRest, restFactor_),
               momentum = firstIteration && !blockStart_ ? (1 - restFactor_) * settings.momentum : 0;
  for (size_t i = 0; i < size(); ++i) {
    if (firstIteration) lambda_[i] = state.warm[i];
    delta_[i] = -omega * (densityRatio_[i] - 1) / denominator_[i];
    const double lambda = std::min(0.0, lambda_[i] + delta_[i] + momentum * momentumPart(lastChange_[i], denominator_[i]));
    lambdaChange_[i] = lambda - lambda_[i];
    lambda_[i] = lambda;
    if (!firstIteration) continue;
    const double gain = kappa * (delta_[i] > 0 ? settings.warmRelease : 1.0);
    state.warm[i] = std::min(0.0, state.warm[i] + gain * delta_[i]);
    if (std::isfinite(settings.warmLimit)) state.warm[i] = std::max(state.warm[i], -settings.warmLimit * step_ * step_);
  }
}

}  // namespace rill::reference
