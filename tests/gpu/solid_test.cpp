// Distances, rays and poses of solids in the shaders against engine/shape, at random points and times.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>

#include "shape/records.hpp"
#include "support/gpu_test.hpp"
#include "support/shaders/solid_query.h"

namespace rill::test {
namespace solid_test {

constexpr Double3 kOrigin = {0, 0, 0};

/// Boxes and spheres within 2 m, every other one of each with keyframes over 3 s.
std::vector<Solid> randomSolids(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-1, 1), size(0.05, 0.8);
  std::normal_distribution<double> normal;
  const auto quaternion = [&](Quaternion& q) {
    double length = 0;
    for (double& part : q) length = std::hypot(length, part = normal(random));
    for (double& part : q) part /= length;
  };
  std::vector<Solid> solids(40);
  for (size_t k = 0; k < solids.size(); ++k) {
    const Double3 c = {place(random), place(random), place(random)}, half = {size(random), size(random), size(random)};
    if (k % 2 == 0)
      solids[k].shape = BoxShape{{c[0] - half[0], c[1] - half[1], c[2] - half[2]}, {c[0] + half[0], c[1] + half[1], c[2] + half[2]}};
    else
      solids[k].shape = SphereShape{c, half[0]};
    quaternion(solids[k].rotation);
    for (int key = 0; key < (k % 4 < 2 ? 0 : 1 + int(k) % 5); ++key) {
      Keyframe& frame = solids[k].motion.emplace_back(Keyframe{0.25 + 0.5 * key, {place(random), place(random), place(random)}});
      if (key != 2) quaternion(frame.rotate);
    }
  }
  return solids;
}

class SolidGeometry : public GpuTest {
 protected:
  std::vector<SolidAnswer> ask(const std::vector<Solid>& solids, const std::vector<SolidQuery>& queries) {
    std::vector<SolidRecord> records;
    std::vector<KeyframeRecord> keyframes;
    for (const Solid& solid : solids) {
      const auto keys = keyframeRecords(solid.motion);
      SolidRecord record{};
      record.base = baseRecord(solid, kOrigin);
      record.shape = recordOf(solid.shape);
      record.firstKey = static_cast<uint32_t>(keyframes.size());
      record.keyCount = static_cast<uint32_t>(keys.size());
      records.push_back(record);
      keyframes.insert(keyframes.end(), keys.begin(), keys.end());
    }
    const Buffer inputs[] = {upload("solids", records), upload("keyframes", keyframes), upload("queries", queries)};
    using enum BindingKind;
    static constexpr BindingKind kBindings[] = {Storage, Storage, Storage, Storage};
    const ComputePipeline* shader = pipeline({.shader = "solid", .spirv = testShader("solid"), .bindings = kBindings});
    Graph graph;
    std::vector<BufferRef> refs;
    for (const Buffer& input : inputs) refs.push_back(graph.import("input", importOf(input)));
    BufferRef answers = graph.create("answers", {queries.size() * sizeof(SolidAnswer)});
    graph.pass("solids", [&](Pass& pass) {
      for (const BufferRef ref : refs) pass.read(ref, Use::ComputeRead);
      answers = pass.write(answers, Use::ComputeWrite, true);
      const Kernel kernel = pass.kernel(shader, {refs[0], refs[1], refs[2], answers});
      return
          [kernel, groups = static_cast<uint32_t>((queries.size() + 63) / 64)](Commands& commands) { commands.dispatch(kernel, groups); };
    });
    const Ticket ticket = graph.readback(answers);
    run(graph);
    return read<SolidAnswer>(graph, ticket);
  }
};

/// Largest difference of two poses; quaternions q and -q are equal.
double difference(const PoseRecord& a, const PoseRecord& b) {
  const float x[] = {a.centerX, a.centerY, a.centerZ, a.velocityX, a.velocityY, a.velocityZ, a.angularX, a.angularY, a.angularZ};
  const float y[] = {b.centerX, b.centerY, b.centerZ, b.velocityX, b.velocityY, b.velocityZ, b.angularX, b.angularY, b.angularZ};
  double worst = 0;
  for (size_t k = 0; k < std::size(x); ++k) worst = std::max<double>(worst, std::abs(x[k] - y[k]));
  const float dot = a.rotationX * b.rotationX + a.rotationY * b.rotationY + a.rotationZ * b.rotationZ + a.rotationW * b.rotationW;
  return std::max<double>(worst, std::abs(1 - std::abs(dot)));
}

TEST_F(SolidGeometry, MatchesHost) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-2, 2), time(0, 3);
  const std::vector<Solid> solids = randomSolids(random);
  std::vector<SolidQuery> queries;
  const auto number = [&](auto& distribution) { return static_cast<float>(distribution(random)); };
  for (uint32_t n = 0; n < 4000; ++n) {
    SolidQuery& q = queries.emplace_back(SolidQuery{n % 40, number(time), 2e-3f, number(place), number(place), number(place)});
    const glm::dvec3 along = glm::normalize(glm::dvec3(place(random), place(random), place(random)));
    q.alongX = static_cast<float>(along.x);
    q.alongY = static_cast<float>(along.y);
    q.alongZ = static_cast<float>(along.z);
  }
  const std::vector<SolidAnswer> answers = ask(solids, queries);
  ASSERT_EQ(answers.size(), queries.size());
  constexpr double kRounding = 2e-5;  // floats of a few m, m/s and rad/s
  size_t hits = 0, unlike = 0;
  for (size_t n = 0; n < queries.size(); ++n) {
    const SolidQuery& q = queries[n];
    const SolidAnswer& got = answers[n];
    const Solid& solid = solids[q.solid];
    const Pose pose = solidPose(solid, q.time);
    EXPECT_LT(difference(got.now, recordOf(pose, kOrigin)), kRounding) << n;
    const Pose next = solidPose(solid, q.time + q.ahead);
    if (next.velocity == pose.velocity) {  // no keyframe between
      EXPECT_LT(difference(got.later, recordOf(next, kOrigin)), kRounding) << n;
    }
    const Double3 x = {q.x, q.y, q.z}, along = {q.alongX, q.alongY, q.alongZ}, speed = velocityAt(pose, x);
    const SurfacePoint point = surfaceAt(solid.shape, pose, x);
    EXPECT_NEAR(got.distance, point.distance, kRounding) << n;
    EXPECT_NEAR(got.velocityX, speed[0], kRounding) << n;
    EXPECT_NEAR(got.velocityY, speed[1], kRounding) << n;
    EXPECT_NEAR(got.velocityZ, speed[2], kRounding) << n;
    // Where two faces are equally far, rounding decides.
    const double same = got.normalX * point.normal[0] + got.normalY * point.normal[1] + got.normalZ * point.normal[2];
    unlike += same < 1 - 1e-4;
    if (point.distance <= 1e-3) continue;
    const auto entry = rayEntry(solid.shape, localPoint(pose, x), toSolid(pose, along));
    if (entry.has_value() != (got.entry > 0)) {
      ++unlike;
      continue;
    }
    if (!entry) continue;
    ++hits;
    EXPECT_NEAR(got.entry, *entry, 1e-3 * (1 + *entry)) << n;  // at a grazing sphere the root magnifies rounding
    const Double3 hit = {x[0] + *entry * along[0], x[1] + *entry * along[1], x[2] + *entry * along[2]};
    EXPECT_NEAR(surfaceAt(solid.shape, pose, hit).distance, 0, 1e-6) << n;
    EXPECT_LT(got.entryX * along[0] + got.entryY * along[1] + got.entryZ * along[2], 1e-3) << n << ": out of the surface";
  }
  EXPECT_GT(hits, 100u);
  EXPECT_LE(unlike, 4u);
}

}  // namespace solid_test
}  // namespace rill::test
