#include "capture/record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "capture/capture.hpp"

namespace rill::capture {
namespace {

Scene scene() {
  Scene made;
  made.name = "small";
  made.domain = Domain{{0, 0, 0}, {1, 1, 1}, 0};
  made.fluid.spacing = 0.1;
  made.probes = {{.name = "H1", .level = std::pair(0.3, 0.1)}};
  return made;
}

offline::Stats stats(double error, double kinetic, double potential) {
  offline::Stats made;
  made.particles = 100;
  made.densityErrorMean = error;
  made.densityErrorP99 = 2 * error;
  made.densityErrorMax = 3 * error;
  made.kinetic_J = kinetic;
  made.potential_J = potential;
  made.stateHash = 0xabc;
  made.wall_s = 0.5;
  made.probes = {{"H1", 0.25}};
  made.passes = {{"density", 1.5, 4, 3}};
  made.skipped = {{"vorticity", "vorticity is 0"}};
  return made;
}

double figure(const Record& record, const std::string& name) {
  for (const Figure& f : record.figures())
    if (f.name == name) return f.value;
  ADD_FAILURE() << name;
  return NAN;
}

TEST(FrameCount, IncludesFirstAndLastInstant) {
  EXPECT_EQ(frameCount(2, 50), 101);
  EXPECT_EQ(frameCount(3, 60), 181);
  EXPECT_EQ(frameCount(0, 60), 1);
  EXPECT_EQ(frameCount(0.3, 60), 19) << "0.3 * 60 is slightly below 18";
  EXPECT_EQ(frameCount(0.99, 1), 1);
}

TEST(Record, WarnsAboutDroppedTimeAndLimits) {
  const Scene small = scene();
  Record whole(small, {}, "");
  whole.add(0, stats(0.001, 1, 1));
  whole.add(0.5, stats(0.001, 1, 1));
  EXPECT_TRUE(whole.warnings().empty());
  EXPECT_EQ(figure(whole, "simulated_s"), 0.5);

  Record cut(small, {}, "");
  offline::Stats some = stats(0.001, 1, 1);
  some.timeDropped_s = 0.125;
  some.loopBoundHits = 1234;
  some.viscosityBoundHits = 56;
  some.viscosityCapped = 78;
  some.nonFinite = 1;
  some.pictureBoundHits = 7;
  cut.add(0, stats(0.001, 1, 1));
  cut.add(0.25, some);
  cut.add(0.5, some);
  EXPECT_EQ(figure(cut, "time_dropped_s"), 0.25);
  EXPECT_EQ(figure(cut, "viscosity_bound_hits"), 56);
  EXPECT_EQ(figure(cut, "viscosity_capped"), 78);
  EXPECT_EQ(nlohmann::json::parse(cut.json())["frames"][1]["viscosity_capped"], 78);
  EXPECT_EQ(figure(cut, "simulated_s"), 0.25) << "dropped time is not simulated";
  const std::vector<std::string> warnings = cut.warnings();
  ASSERT_EQ(warnings.size(), 6u);
  for (const auto& [k, what] : {std::pair(0, "0.25 s of 0.5 s were dropped: "),
                                {1, "56 substeps viscosity needed more steps"},
                                {2, "on 78 of "},
                                {3, "1,234 times"},
                                {4, "1 particle is"},
                                {5, "14 times"}})
    EXPECT_NE(warnings[k].find(what), std::string::npos) << warnings[k];
}

TEST(Record, NamesBlockedEmitters) {
  Scene flows = scene();
  flows.emitters.resize(5);
  flows.domain->inflow = Inflow{.side = Axis::MinusX, .level = 0.5, .speed = 1};
  const auto warningOf = [&](std::vector<double> blocked_s, bool full) {
    Record record(flows, {}, "");
    offline::Stats last = stats(0, 0, 0);
    last.emitterBlocked_s = *std::ranges::max_element(blocked_s);
    last.emittersBlocked_s = std::move(blocked_s);
    last.ledger.full = full;
    record.add(0, last);
    const auto warnings = record.warnings();
    return warnings.empty() ? "" : warnings.front();
  };
  const std::string solid = ": a mouth, or a part of one, was in a solid or behind a wall";
  EXPECT_EQ(warningOf({0, 0, 0, 0, 0, 0}, false), "");
  EXPECT_EQ(warningOf({0, 0.5, 0, 0, 0, 0}, false), "warning: emitters[1] was blocked for 0.5 s" + solid);
  EXPECT_EQ(warningOf({0.25, 0, 0, 0, 0, 0.5}, false), "warning: emitters[0], domain.inflow were blocked for 0.5 s" + solid);
  EXPECT_EQ(
      warningOf({1, 1, 1, 1, 1, 2}, true),
      "warning: emitters[0], emitters[1], emitters[2] and 3 more were blocked for 2 s: the room for particles (fluid.capacity) was full");
}

TEST(Record, TellsHowManyParticlesSleepWhereAsked) {
  Scene small = scene();
  EXPECT_EQ(Record(small, {}, "").sleepText(), "");
  small.solver.sleep = true;
  offline::Stats awake = stats(0.001, 1, 1), asleep = awake;
  awake.sleeping = 0;
  awake.substeps = 36;
  asleep.sleeping = asleep.particles = 1234;
  Record record(small, {}, "");
  record.add(0, awake);
  record.add(0.5, asleep);
  EXPECT_EQ(record.sleepText(), "asleep at the end: 1,234 of 1,234 particles; 1 of 2 frames without substeps\n");
  EXPECT_EQ(figure(record, "sleeping"), 1234);
  EXPECT_EQ(nlohmann::json::parse(record.json())["frames"][1]["sleeping"], 1234);
  EXPECT_TRUE(std::ranges::count(Record::figureNames(small), "sleeping"));
  small.gravity = {0, 0, 0};
  EXPECT_FALSE(std::ranges::count(Record::figureNames(small), "sleeping")) << "nothing can sleep";
}

TEST(Record, CountsWhitewaterWhereTheSceneHasIt) {
  Scene foamy = scene();
  foamy.look.whitewater = true;
  offline::Stats some = stats(0.001, 1, 1);
  some.whitewater = WhitewaterStats{.spray = 1, .foam = 20, .bubbles = 300, .emitted = 4000, .dissolved = 50, .overflow = 7};
  Record record(foamy, {}, "");
  record.add(0, some);
  const auto frame = nlohmann::json::parse(record.json())["frames"][0]["whitewater"];
  EXPECT_EQ(frame["spray"], 1);
  EXPECT_EQ(frame["bubbles"], 300);
  EXPECT_EQ(frame["overflow"], 7);
  EXPECT_EQ(figure(record, "whitewater.foam"), 20);
  EXPECT_EQ(figure(record, "whitewater.emitted"), 4000);
  const auto warnings = record.warnings();
  EXPECT_TRUE(std::ranges::any_of(warnings, [](const std::string& w) { return w.find("no room for 7 of") != std::string::npos; }));
  const auto names = Record::figureNames(foamy);
  EXPECT_NE(std::ranges::find(names, "whitewater.dissolved"), names.end());
}

TEST(Record, DensityErrorExcludesFirstTenth) {
  const Scene small = scene();
  Record record(small, {}, "");
  for (int k = 0; k < 10; ++k) record.add(k / 10.0, stats(k == 0 ? 9.0 : 0.001 * k, 1, 1));
  EXPECT_NEAR(figure(record, "density_error_mean"), 0.005, 1e-12);
  EXPECT_NEAR(figure(record, "density_error_p99"), 0.018, 1e-12);
  EXPECT_NEAR(figure(record, "density_error_max"), 0.027, 1e-12);
  Record one(small, {}, "");
  one.add(0, stats(0.5, 1, 1));
  EXPECT_EQ(figure(one, "density_error_mean"), 0.5) << "a single frame is included";
}

TEST(Record, EnergyIsMeasuredFromLowestCorner) {
  Scene high = scene();
  high.domain = Domain{{0, -10, 0}, {1, -9, 1}, 0};
  const double mass = 100 * 1000 * 0.001, floor = mass * 9.81 * -10;
  Record record(high, {}, "");
  record.add(0, stats(0, 0, floor + 400));
  record.add(1, stats(0, 104, floor + 300));
  EXPECT_NEAR(figure(record, "energy_ratio"), 1.01, 1e-9);
  Record resting(high, {}, "");
  resting.add(0, stats(0, 0, floor));
  EXPECT_EQ(figure(resting, "energy_ratio"), 1) << "no energy at the start";
}

TEST(Record, EnergyCountsEachFluidsMass) {
  Scene two = scene();
  two.domain = Domain{{0, -10, 0}, {1, -9, 1}, 0};
  two.fluids = {{.name = "water"}, {.name = "oil", .density = 500}};
  const double mass = (60 * 1000 + 40 * 500) * 0.001, floor = mass * 9.81 * -10;
  Record record(two, {}, "");
  for (const double kinetic : {0.0, 4.0}) {
    offline::Stats at = stats(0, kinetic, floor + 400);
    at.fluids = {{.particles = 60}, {.particles = 40}};
    record.add(kinetic, at);
  }
  EXPECT_NEAR(figure(record, "energy_ratio"), 1.01, 1e-9);
}

TEST(Record, WritesDocumentedJsonKeys) {
  const Scene small = scene();
  DeviceInfo device;
  device.name = "llvmpipe";
  Record record(small, device, "rill-capture small");
  record.add(0, stats(0.001, 1, 1));
  offline::Stats broken = stats(std::numeric_limits<double>::quiet_NaN(), 1, 1);
  broken.maxSpeed = std::numeric_limits<double>::infinity();
  record.add(0.5, broken);
  const auto json = nlohmann::json::parse(record.json());
  for (const char* key : {"rill", "scene", "device", "particles", "simulated_s", "wall_s", "density_error", "frames", "command", "energy"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(json["scene"], "small");
  EXPECT_EQ(json["device"]["name"], "llvmpipe");
  EXPECT_EQ(json["simulated_s"], 0.5);
  EXPECT_EQ(json["wall_s"], 1.0);
  ASSERT_EQ(json["frames"].size(), 2u);
  const auto& frame = json["frames"][0];
  for (const char* key : {"time_s",
                          "particles",
                          "substeps",
                          "iterations",
                          "time_dropped_s",
                          "density_error_mean",
                          "density_error_p99",
                          "density_error_max",
                          "kinetic_J",
                          "potential_J",
                          "momentum",
                          "centre_of_mass",
                          "front_m",
                          "max_speed",
                          "non_finite",
                          "outside",
                          "neighbour_overflow",
                          "artificial_viscosity_Pa_s",
                          "state_hash",
                          "probes",
                          "fluids",
                          "wall_s",
                          "pass_ms",
                          "skipped"})
    EXPECT_TRUE(frame.contains(key)) << key;
  EXPECT_EQ(frame["state_hash"], "0000000000000abc");
  EXPECT_EQ(frame["momentum"].size(), 3u);
  EXPECT_EQ(frame["probes"]["H1"], 0.25);
  EXPECT_EQ(frame["pass_ms"]["density"], 1.5);
  EXPECT_EQ(frame["skipped"]["vorticity"], "vorticity is 0");
  EXPECT_TRUE(json["frames"][1]["density_error_mean"].is_null());
  EXPECT_TRUE(json["frames"][1]["max_speed"].is_null());
}

TEST(Record, WritesValidJsonWithoutFrames) {
  const Scene small = scene();
  const auto json = nlohmann::json::parse(Record(small, {}, "").json());
  EXPECT_TRUE(json["frames"].empty());
}

TEST(Record, PassTableListsRunsAndSkips) {
  const Scene small = scene();
  Record record(small, {}, "");
  record.add(0, stats(0, 1, 1));
  record.add(1, stats(0, 1, 1));
  const std::string table = record.passTable();
  EXPECT_NE(table.find("density                                      8         6       3.000     500.00"), std::string::npos) << table;
  EXPECT_NE(table.find("skipped: vorticity is 0"), std::string::npos) << table;
}

TEST(Requirement, ParsesAllComparisons) {
  EXPECT_TRUE(parseRequirement("outside<1")->holds(0));
  EXPECT_FALSE(parseRequirement("outside<1")->holds(1));
  EXPECT_TRUE(parseRequirement("outside <= 1")->holds(1));
  EXPECT_TRUE(parseRequirement("front_m>1e-3")->holds(0.01));
  EXPECT_TRUE(parseRequirement("front_m>=0.01")->holds(0.01));
  EXPECT_FALSE(parseRequirement("front_m>=0.01")->holds(NAN));
  for (const char* text : {"", "outside", "<1", "outside<", "outside<x", "outside<1x", "outside=1", "outside<nan", "outside<inf"})
    EXPECT_FALSE(parseRequirement(text)) << text;
}

TEST(Requirement, UnknownFigureSuggestsNearest) {
  const std::vector<Requirement> wanted = {*parseRequirement("density_eror_mean<1")};
  const auto known = checkFigures(wanted, Record::figureNames(scene()));
  ASSERT_FALSE(known);
  EXPECT_NE(known.error().message.find("did you mean \"density_error_mean\"?"), std::string::npos) << known.error().message;
  EXPECT_NE(known.error().message.find("probes.H1"), std::string::npos);
  EXPECT_TRUE(checkFigures(std::vector<Requirement>{*parseRequirement("probes.H1>0")}, Record::figureNames(scene())));
}

TEST(Requirement, FailureReportsValue) {
  const std::vector<Figure> figures = {{"outside", 3, ""}, {"energy_ratio", NAN, ""}};
  const std::vector<Requirement> wanted = {*parseRequirement("outside<1"), *parseRequirement("outside<4"),
                                           *parseRequirement("energy_ratio<2")};
  const auto broken = failures(wanted, figures);
  ASSERT_EQ(broken.size(), 2u);
  EXPECT_NE(broken[0].find("outside is 3"), std::string::npos);
  EXPECT_NE(broken[1].find("undefined"), std::string::npos);
}

}  // namespace
}  // namespace rill::capture
