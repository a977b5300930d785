#include <gtest/gtest.h>

#include <cstring>

#include "capture/output_folder.hpp"
#include "fill/ply_reader.hpp"
#include "shared/message.hpp"
#include "shared/ply.hpp"
#include "shared/png.hpp"
#include "shared/progress.hpp"
#include "shared/scene_folders.hpp"
#include "support/temporary_folder.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace rill::apps {
namespace {

using test::contentOf;
using test::TemporaryFolder;

TEST(Ply, EncodesBinaryLittleEndian) {
  offline::Particles particles;
  particles.positions = {{1, 2, 3}, {4, 5, 6}};
  particles.velocities = {{-1, 0, 0.5f}, {0, 0, 0}};
  particles.densities = {1000, 998};
  particles.ids = {7, 4000000000u};
  const auto bytes = encodePly(particles, 0.25);
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment time 0.25\nelement vertex 2\n"
      "property float x\nproperty float y\nproperty float z\nproperty float vx\nproperty float vy\nproperty float vz\nproperty float "
      "density\nproperty uint id\nend_header\n";
  ASSERT_EQ(text.substr(0, header.size()), header);
  ASSERT_EQ(bytes.size(), header.size() + 2 * 32);
  float values[7];
  uint32_t id = 0;
  std::memcpy(values, bytes.data() + header.size() + 32, sizeof values);
  std::memcpy(&id, bytes.data() + header.size() + 32 + 28, sizeof id);
  EXPECT_EQ(values[0], 4);
  EXPECT_EQ(values[6], 998);
  EXPECT_EQ(id, 4000000000u);
}

TEST(Ply, EncodesConcentrationsOfFluidsThatDiffuse) {
  offline::Particles particles;
  particles.positions = particles.velocities = {{1, 2, 3}, {4, 5, 6}};
  particles.densities = {1000, 900};
  particles.ids = {7, 8};
  particles.fluids = {0, 1};
  particles.diffusing = {1, 3};
  particles.concentrations = {{0.25F, 1}, {0.5F, 0}};
  const TemporaryFolder folder;
  ASSERT_TRUE(writePly(folder / "mixed.ply", particles, 0));
  const auto file = PlyFile::open(folder / "mixed.ply", 4, particles.diffusing);
  ASSERT_TRUE(file) << file.error().message;
  const auto read = file->read();
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->fluids, particles.fluids);
  EXPECT_EQ(read->concentrations, (std::vector<Float4>{{0.25F, 0.5F, 0, 0}, {1, 0, 0, 0}}));
  constexpr size_t kOther[] = {2};
  EXPECT_TRUE(PlyFile::open(folder / "mixed.ply", 4, kOther)->read()->concentrations.empty()) << "the file has none of this fluid";
}

TEST(Ply, EncodesFluidsWhereThereAreSeveral) {
  offline::Particles particles;
  particles.positions = {{1, 2, 3}, {4, 5, 6}};
  particles.velocities = {{-1, 0, 0.5f}, {0, 0, 7}};
  particles.densities = {1000, 900};
  particles.ids = {7, 8};
  particles.fluids = {0, 1};
  const TemporaryFolder folder;
  ASSERT_TRUE(writePly(folder / "frame_00000.ply", particles, 0.25));
  EXPECT_NE(contentOf(folder / "frame_00000.ply").find("property uint id\nproperty uchar fluid\nend_header\n"), std::string::npos);

  Scene scene;
  scene.fluid.spacing = 0.1;
  scene.fluids = {{.name = "water"}, {.name = "oil"}};
  scene.fill = {{.shape = ParticleFile{folder / "frame_00000.ply"}}};
  const auto set = makeParticles(scene);
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_EQ(set->fluids, (std::vector<uint8_t>{0, 1}));
  ASSERT_EQ(set->velocities.size(), 2U);
  EXPECT_EQ(set->velocities[1], (Float3{0, 0, 7}));
}

TEST(Ply, EncodesWhitewaterWithClasses) {
  offline::DiffuseParticles particles;
  particles.positions = {{1, 2, 3}, {4, 5, 6}};
  particles.velocities = {{-1, 0, 0.5f}, {0, 0, 7}};
  particles.ages = {0.25f, 1.5f};
  particles.classes = {WhitewaterClass::Spray, WhitewaterClass::Bubble};
  particles.randoms = {0, (1 << 24) - 1};
  const auto bytes = encodeWhitewaterPly(particles, 0.25);
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment time 0.25\ncomment class 0 spray, 1 foam, 2 bubble\nelement vertex 2\n"
      "property float x\nproperty float y\nproperty float z\nproperty float vx\nproperty float vy\nproperty float vz\nproperty float "
      "age\nproperty uint random\nproperty uchar class\nend_header\n";
  ASSERT_EQ(text.substr(0, header.size()), header);
  ASSERT_EQ(bytes.size(), header.size() + 2 * 33);
  float values[7];
  std::memcpy(values, bytes.data() + header.size() + 33, sizeof values);
  EXPECT_EQ(values[0], 4);
  EXPECT_EQ(values[5], 7);
  EXPECT_EQ(values[6], 1.5f);
  EXPECT_EQ(static_cast<int>(bytes.back()), 2);
}

TEST(Ply, EncodesHeaderWithoutParticles) {
  const auto bytes = encodePly({}, 1.0 / 3);
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  EXPECT_NE(text.find("comment time 0.3333333333333333\n"), std::string::npos);
  EXPECT_TRUE(text.ends_with("end_header\n"));
}

TEST(Png, RoundTrips) {
  const TemporaryFolder folder;
  for (const bool opaque : {true, false}) {
    offline::Image image{5, 3, std::vector<uint8_t>(5 * 3 * 4)};
    for (size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = i % 4 == 3 ? (opaque ? 255 : uint8_t(i)) : uint8_t(17 * i);
    ASSERT_TRUE(writePng(folder / "a.png", image));
    const std::string file = contentOf(folder / "a.png");
    int width = 0, height = 0, channels = 0;
    stbi_uc* pixels = stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(file.data()), int(file.size()), &width, &height, &channels, 4);
    ASSERT_NE(pixels, nullptr);
    EXPECT_EQ(width, 5);
    EXPECT_EQ(height, 3);
    EXPECT_EQ(channels, opaque ? 3 : 4);
    EXPECT_EQ(std::memcmp(pixels, image.rgba.data(), image.rgba.size()), 0);
    stbi_image_free(pixels);
  }
}

TEST(OutputFolder, RemovesOnlyEarlierFrames) {
  const TemporaryFolder folder;
  for (const char* name : {"frame_00000.png", "frame_00012.ply", "frame_123456.png", ".frame_00003.png.99.part", "frame_0001.png",
                           "frame_00001.jpg", "frame_0000x.png", "notes.txt", ".notes.txt.99.part"})
    folder.write(name, "x");
  auto prepared = capture::OutputFolder::prepare(folder.path());
  ASSERT_TRUE(prepared);
  EXPECT_EQ(folder.names(),
            (std::vector<std::string>{".notes.txt.99.part", "frame_00001.jpg", "frame_0000x.png", "frame_0001.png", "notes.txt"}));
  EXPECT_EQ(prepared->frame(42, "png").filename(), "frame_00042.png");
  EXPECT_EQ(prepared->frame(1234567, "ply").filename(), "frame_1234567.ply");
  EXPECT_FALSE(capture::OutputFolder::prepare(folder.path())) << "locked";
}

TEST(OutputFolder, LockedFolderKeepsItsFrames) {
  const TemporaryFolder folder;
  auto first = capture::OutputFolder::prepare(folder.path());
  ASSERT_TRUE(first);
  folder.write("frame_00000.png", "x");
  EXPECT_FALSE(capture::OutputFolder::prepare(folder.path()));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"frame_00000.png"});
}

TEST(Progress, TextHasCountDetailsAndTime) {
  EXPECT_EQ(progressText({"frame", 3, 181, "t 0.033 s  error 0.041 %", 6}), "frame 3/181  t 0.033 s  error 0.041 %  left 5 min 56 s");
  EXPECT_EQ(progressText({"frame", 181, 181, "t 3.000 s  error 0.050 %", 61.2}),
            "frame 181/181  t 3.000 s  error 0.050 %  took 1 min 02 s");
}

TEST(Progress, BarFitsTerminal) {
  const ProgressState half{"frame", 50, 100, "t 0.800 s  error 0.100 %", 30};
  const std::string bar = progressBar(half, 120);
  EXPECT_EQ(bar.substr(0, 27), "[############............] ");
  EXPECT_EQ(progressBar({"case", 100, 100, "", 1}, 120).substr(0, 26), "[" + std::string(24, '#') + "]");
  for (const int columns : {1, 10, 40, 60, 79, 80, 200}) EXPECT_LT(int(progressBar(half, columns).size()), std::max(columns, 2)) << columns;
}

TEST(Progress, FormatsDurations) {
  EXPECT_EQ(formatDuration(0), "0 s");
  EXPECT_EQ(formatDuration(59.2), "1 min 00 s");
  EXPECT_EQ(formatDuration(3725), "1 h 02 min");
  EXPECT_EQ(formatDuration(-1), "?");
  EXPECT_EQ(formatDuration(std::nan("")), "?");
}

TEST(Printable, EscapesControlCharactersAndInvalidUtf8) {
  EXPECT_EQ(printable("plain text,\nwith lines"), "plain text,\nwith lines");
  EXPECT_EQ(printable("m\xC3\xB6glich \xE2\x82\xAC \xF0\x9F\x8C\x8A"), "m\xC3\xB6glich \xE2\x82\xAC \xF0\x9F\x8C\x8A");
  EXPECT_EQ(printable("\x1b[31m\r\x7f"), "\\u001b[31m\\u000d\\u007f");
  EXPECT_EQ(printable("\xC2\x9B"), "\\u009b") << "C1 control character";
  EXPECT_EQ(printable("\xff\x9b"), "\\xff\\x9b");
  EXPECT_EQ(printable("\xE2\x82"), "\\xe2\\x82") << "cut short";
  EXPECT_EQ(printable("\xC0\x80"), "\\xc0\\x80") << "overlong";
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xed\\xa0\\x80") << "surrogate";
}

TEST(SceneFolders, FindsByNameAndSuggestsNearest) {
  const TemporaryFolder first, second;
  std::filesystem::create_directories(second / "validation");
  first.write("dam-break.json", "{}");
  first.write("scene.schema.json", "{}");
  second.write("dam-break.json", "{}");
  second.write("validation/column.json", "{}");
  const SceneFolders folders({first.path(), second / "missing", second.path()});
  EXPECT_EQ(folders.names(), (std::vector<std::string>{"dam-break", "validation/column"}));
  EXPECT_EQ(*folders.find("dam-break"), first / "dam-break.json");
  EXPECT_EQ(*folders.find("validation/column"), second / "validation/column.json");
  EXPECT_EQ(*folders.find("any/path.json"), "any/path.json");
  EXPECT_EQ(*folders.find((second / "dam-break.json").string()), second / "dam-break.json");
  const auto unknown = folders.find("dambreak");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("did you mean \"dam-break\"?"), std::string::npos) << unknown.error().message;
  EXPECT_NE(unknown.error().message.find("validation/column"), std::string::npos);
}

}  // namespace
}  // namespace rill::apps
