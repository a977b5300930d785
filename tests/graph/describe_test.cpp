// Reports of the graph: memory with and without aliasing, placements, lifetimes.
#include <nlohmann/json.hpp>

#include "graph_fixture.hpp"

namespace rill::test {
namespace {

class Describe : public GraphTest {
 protected:
  /// Three buffers of 1000 bytes of which only consecutive ones overlap in lifetime; a culled pass; an image with two levels.
  void declare() {
    BufferRef at = write("make", graph.create("first", {1000}));
    at = readWrite("second pass", at, Use::ComputeRead, graph.create("second", {1000}));
    at = readWrite("third pass", at, Use::ComputeRead, graph.create("third", {1000}));
    read("look", at);
    (void)write("idle", graph.create("nobody's", {64}));
    ImageRef image = graph.create("picture", {VK_FORMAT_R32_SFLOAT, 16, 8, 2});
    graph.pass("draw", [&](Pass& pass) {
      image = pass.write(image, Use::ComputeWrite);
      (void)pass.write(graph.level(image, 1), Use::ComputeWrite);
      pass.sideEffect();
      return [](Commands&) {};
    });
    compile();
  }
};

TEST_F(Describe, ReportsHeapSizesWithAndWithoutAliasing) {
  declare();
  const auto heaps = graph.transientHeaps();
  ASSERT_EQ(heaps.size(), 2u);
  EXPECT_FALSE(heaps[0].images);
  EXPECT_EQ(heaps[0].transients, 3u);
  EXPECT_EQ(heaps[0].bytes, 1024u + 1000);
  EXPECT_EQ(heaps[0].separate, 2 * 1024u + 1000);
  EXPECT_TRUE(heaps[1].images);
  EXPECT_EQ(heaps[1].transients, 1u) << "an image with mip levels has one placement";
  EXPECT_EQ(heaps[1].bytes, heaps[1].separate);
  EXPECT_EQ(graph.transientBytes(), heaps[0].bytes + heaps[1].bytes);
  const auto json = nlohmann::json::parse(graph.json());
  ASSERT_EQ(json["heaps"].size(), 2u);
  EXPECT_EQ(json["heaps"][0]["kind"], "buffers");
  EXPECT_EQ(json["heaps"][0]["bytes"], 2024);
  EXPECT_EQ(json["heaps"][0]["bytes_without_aliasing"], 3048);
  EXPECT_EQ(json["heaps"][1]["kind"], "images");
}

TEST_F(Describe, AliasedTransientsHaveDisjointLifetimes) {
  declare();
  const auto all = graph.transients();
  ASSERT_EQ(all.size(), 4u) << "three buffers, one image";
  bool shared = false;
  for (const TransientReport& a : all) {
    EXPECT_FALSE(a.name.empty());
    EXPECT_GT(a.bytes, 0u);
    EXPECT_LE(a.first, a.last);
    for (const TransientReport& b : all) {
      if (&a == &b || a.image != b.image || a.heap != b.heap || a.offset + a.bytes <= b.offset || b.offset + b.bytes <= a.offset) continue;
      shared = true;
      EXPECT_TRUE(a.last < b.first || b.last < a.first) << a.name << ", " << b.name;
    }
  }
  EXPECT_TRUE(shared);
}

TEST_F(Describe, DotShowsPlacementAndLifetime) {
  declare();
  const std::string dot = graph.dot();
  for (const char* wanted :
       {"label=\"first\\n1000 bytes in heap 0 from 0 bytes\\npasses 0 to 1\"",
        "label=\"second\\n1000 bytes in heap 0 from 1024 bytes\\npasses 1 to 2\"",
        "label=\"third\\n1000 bytes in heap 0 from 0 bytes\\npasses 2 to 3\"", "4  idle\\nculled: nothing reads 'nobody's'\", style=dashed",
        "label=\"nobody's\\nunused\"", "label=\"picture, level 0\\n16 x 8, format 100\\n",
        "label=\"picture, level 1\\n8 x 4, format 100\\n", "passes 5 to 5\""})
    EXPECT_NE(dot.find(wanted), std::string::npos) << wanted << "\n" << dot;
}

}  // namespace
}  // namespace rill::test
