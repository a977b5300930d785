// rill-view from end to end, in a window on a virtual display (Xvfb), with validation.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "view_window/view_window.hpp"

namespace rill::test {
namespace {

TEST_F(ViewWindowTest, OpensDrawsAndCloses) {
  for (const char* scale : {"1", "2.5"}) {
    const Outcome outcome = view({scene, "--frames", "5", "--scale", scale, "--screenshot", "last.png", "--validate"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(figure(outcome, "frames"), "5");
    EXPECT_GT(std::stod("0" + figure(outcome, "frame_ms")), 0);
    EXPECT_EQ(sizeOf("last.png"), std::pair(1280, 720));
  }
}

TEST_F(ViewWindowTest, LockstepFramesEqualThoseOfCapture) {
  const Outcome shown = view({scene, "--frames", "7", "--lockstep", "--size", "320x200", "--validate"});
  ASSERT_EQ(shown.code, 0) << shown.err;
  const Outcome captured = capture({scene, "--frames", "7", "--no-images", "--quiet", "--stats", "stats.json"}, folder.string());
  ASSERT_EQ(captured.code, 0) << captured.err;
  const auto stats = nlohmann::json::parse(contentOf(folder / "stats.json"));
  EXPECT_EQ(figure(shown, "steps"), "6");
  EXPECT_EQ(figure(shown, "state_hash"), stats["frames"][6]["state_hash"].get<std::string>());
}

TEST_F(ViewWindowTest, ScriptSwitchesViewsKeysAndSizes) {
  std::string script;
  int frame = 0;
  for (const char* view : {"final", "particles", "density", "speed", "depth", "normals", "thickness"})
    script += std::to_string(frame++) + " view " + view + "\n";
  const int first = frame;
  for (const char* key : {"V", "F1", "F1", "Tab", "Tab", "L", "P", "O", "P", "R", "1", "2", "3", "4", "5", "6", "Home", "Left", "Up"})
    script += std::to_string(frame++) + " key " + key + "\n";
  script += std::to_string(frame) + " move 640 300\n" + std::to_string(frame) + " press left\n";
  script += std::to_string(frame + 1) + " move 700 340\n" + std::to_string(frame + 2) + " release left\n";
  script += std::to_string(frame + 2) + " wheel 3\n" + std::to_string(frame + 3) + " wheel -2\n";
  frame += 4;
  for (const char* size : {"900 500", "200 100", "64 64", "1280 720"}) script += std::to_string(frame += 2) + " resize " + size + "\n";
  script += std::to_string(frame + 1) + " minimize\n" + std::to_string(frame + 3) + " restore\n";
  script += std::to_string(frame + 4) + " set fluid.viscosity=0.1\n" + std::to_string(frame + 5) + " set fluid.spacing=0.06\n";
  script += std::to_string(frame + 6) + " set fluid.viscosity=-3\n";
  script += std::to_string(frame + 7) + " screenshot end.png\n";
  folder.write("hands.txt", script);
  const Outcome outcome = view({scene, "--script", "hands.txt", "--validate"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_GT(std::stoi("0" + figure(outcome, "frames")), first);
  EXPECT_EQ(sizeOf("end.png"), std::pair(1280, 720));
}

TEST_F(ViewWindowTest, ReplaysEndInEqualStates) {
  folder.write("hands.txt", "0 key P\n2 key P\n5 set fluid.viscosity=2\n8 set gravity=[3,-9.81,0]\n14 view depth\n");
  const Outcome one = view({scene, "--script", "hands.txt", "--size", "320x200"});
  const Outcome two = view({scene, "--script", "hands.txt", "--size", "400x300", "--view", "particles"});
  ASSERT_EQ(one.code, 0) << one.err;
  ASSERT_EQ(two.code, 0) << two.err;
  EXPECT_EQ(figure(one, "steps"), "13") << "fifteen frames, the first two paused";
  EXPECT_EQ(figure(one, "state_hash"), figure(two, "state_hash"));
  EXPECT_EQ(figure(one, "state_hash").size(), 16u);
}

TEST_F(ViewWindowTest, MouseInteractionReplaysBitwise) {
  folder.write("solid.json", R"({
    "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1, 1, 0.3]}, "fluid": {"spacing": 0.05},
    "fill": [{"box": {"min": [0, 0, 0], "max": [1, 0.4, 0.3]}}],
    "solids": [{"box": {"min": [0.4, 0.5, 0.05], "max": [0.6, 0.7, 0.25]}}],
    "camera": {"eye": [0.5, 0.5, 2.2], "target": [0.5, 0.5, 0], "fov_y_deg": 40}
  })");
  // The picture is 320x200 at once, without panels: the water's middle lies below the middle, the box a little above.
  const std::string still = "0 key Tab\n12 view particles\n";
  folder.write("still.txt", still);
  const std::string push = still + "13 move 120 145\n13 press left\n14 move 160 150\n18 move 900 -50\n22 move 100 150\n26 release left\n";
  const std::string move = still + "27 move 160 80\n27 press right\n28 move 160 150\n40 move 60 140\n44 release right\n";
  const std::string thrown = still + "45 move 160 60\n45 key Space\n46 key Space\n";
  folder.write("push.txt", push);
  folder.write("move.txt", move);
  folder.write("thrown.txt", thrown);
  folder.write("restarted.txt", still + "50 move 120 145\n50 press left\n52 key R\n53 release left\n");
  const auto run = [&](const std::string& script) {
    std::vector<std::string> arguments = {
        (folder / "solid.json").string(), "--script", script, "--size", "320x200", "--lockstep", "--frames", "57"};
    if (script == "thrown.txt" || script == "restarted.txt") arguments.push_back("--validate");  // what the others do is in thrown.txt, too
    return view(arguments);
  };
  const Outcome untouched = run("still.txt"), again = run("push.txt");
  for (const char* script : {"push.txt", "move.txt", "thrown.txt"}) {
    const Outcome touched = run(script);
    ASSERT_EQ(touched.code, 0) << script << ": " << touched.err;
    EXPECT_EQ(touched.err, "") << script;
    EXPECT_EQ(figure(touched, "steps"), figure(untouched, "steps")) << script;
    EXPECT_NE(figure(touched, "state_hash"), figure(untouched, "state_hash")) << script << " has an effect";
    if (std::string_view(script) == "push.txt") { EXPECT_EQ(figure(touched, "state_hash"), figure(again, "state_hash")); }
  }
  const Outcome restarted = run("restarted.txt");
  ASSERT_EQ(restarted.code, 0) << restarted.err;
  EXPECT_EQ(figure(restarted, "steps"), "4") << "R while the fluid is held; its frame shows the start";
}

TEST_F(ViewWindowTest, CratesAreThrownAndBodiesPulledByScript) {
  folder.write("harbor.json", R"({
    "rill": "0.2", "domain": {"min": [0, 0, 0], "max": [1, 1, 0.3]}, "fluid": {"spacing": 0.05},
    "fill": [{"box": {"min": [0, 0, 0], "max": [1, 0.3, 0.3]}}],
    "solids": [{"name": "buoy", "box": {"min": [0.2, 0.2, 0.05], "max": [0.4, 0.4, 0.25]}, "body": {"density": 500}}],
    "camera": {"eye": [0.5, 0.5, 2.2], "target": [0.5, 0.5, 0], "fov_y_deg": 40}
  })");
  // Of 200 pixels of the picture a meter takes about 130: the buoy is left of the middle and below it.
  const std::string begin = "0 key Tab\n";
  folder.write("still.txt", begin);
  folder.write("thrown.txt", begin + "3 move 200 60\n3 key B\n");
  folder.write("pulled.txt", begin + "3 move 132 130\n3 press right\n4 move 132 60\n18 release right\n");
  const auto run = [&](const char* script) {
    return view({(folder / "harbor.json").string(), "--script", script, "--size", "320x200", "--frames", "22", "--validate"});
  };
  const Outcome still = run("still.txt");
  EXPECT_EQ(figure(still, "bodies"), "1");
  for (const char* script : {"thrown.txt", "pulled.txt"}) {
    const Outcome touched = run(script);
    EXPECT_EQ(touched.code, 0) << touched.err;
    EXPECT_EQ(touched.err, "") << script;
    EXPECT_EQ(figure(touched, "particles"), figure(still, "particles"));
    EXPECT_EQ(figure(touched, "bodies"), std::string_view(script) == "thrown.txt" ? "2" : "1");
    EXPECT_NE(figure(touched, "state_hash"), figure(still, "state_hash")) << script;
    EXPECT_EQ(figure(touched, "state_hash"), figure(run(script), "state_hash")) << script;
  }
}

TEST_F(ViewWindowTest, ChangesOneOfSeveralFluids) {
  const std::string two = folder
                              .write("two.json", R"({
    "rill": "0.2", "domain": {"max": [1, 1, 0.3]}, "fluid": {"spacing": 0.05},
    "fluids": [{"name": "water"}, {"name": "oil", "density": 900, "viscosity": 0.05}],
    "fill": [{"box": {"max": [0.5, 0.3, 0.3]}}, {"fluid": "oil", "box": {"min": [0, 0.3, 0], "max": [0.5, 0.5, 0.3]}}]
  })")
                              .string();
  folder.write("thick.txt", "3 set fluids.oil.viscosity=2\n4 set fluids[1].viscosity=-1\n");
  folder.write("dense.txt", "3 set fluids[1].density=700\n");
  const Outcome thick = view({two, "--script", "thick.txt", "--frames", "7", "--lockstep", "--validate"});
  EXPECT_EQ(thick.code, 0) << thick.err;
  EXPECT_EQ(thick.err, "");
  EXPECT_EQ(figure(thick, "steps"), "6");
  const Outcome dense = view({two, "--script", "dense.txt", "--frames", "7", "--lockstep", "--validate"});
  EXPECT_EQ(dense.code, 0) << dense.err;
  EXPECT_LT(std::stoi("0" + figure(dense, "steps")), 6) << "a density restarts the scene";
}

TEST_F(ViewWindowTest, PanelsConsumeTheirClicks) {
  // On the button "Pause (P)", and in the picture, where it does not pause.
  folder.write("click.txt", "1 move 42 97\n1 press left\n2 release left\n9 view final\n");
  folder.write("beside.txt", "1 move 640 300\n1 press left\n2 release left\n9 view final\n");
  const Outcome paused = view({scene, "--script", "click.txt"}), running = view({scene, "--script", "beside.txt"});
  ASSERT_EQ(paused.code, 0) << paused.err;
  EXPECT_LE(std::stoi("0" + figure(paused, "steps")), 3);
  EXPECT_EQ(figure(running, "steps"), "9");
}

TEST_F(ViewWindowTest, SavedSceneContainsChanges) {
  folder.write("save.txt", "1 set fluid.viscosity=0.5\n2 move 49 123\n2 press left\n3 release left\n6 view final\n");
  const Outcome outcome = view({scene, "--script", "save.txt"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto saved = nlohmann::json::parse(contentOf(folder / "dam-changed.json"));
  EXPECT_EQ(saved["fluid"]["viscosity"], 0.5);
  EXPECT_EQ(saved["fluid"]["spacing"], 0.05);
}

TEST_F(ViewWindowTest, NumbersCanBeTypedAndDragged) {
  // The field of fluid.viscosity; "Save scene" is at 49, 123. All within one frame: clicks and keys wait for each other.
  const std::string save = "move 49 123\n30 press left\n30 release left\n38 view particles\n";
  const struct {
    const char* hands;
    double low, high;
  } rows[] = {{"5 move 84 431\n5 press left\n5 release left\n5 press left\n5 release left\n14 type 8\n14 key Enter\n20 key L\n30 ", 8, 8},
              {"5 move 84 431\n5 press Ctrl+left\n5 release left\n10 type 0.25\n10 key Enter\n30 ", 0.25, 0.25},
              {"5 move 84 431\n5 press left\n7 move 134 431\n9 move 234 431\n11 release left\n30 ", 0.2, 50}};
  for (const auto& row : rows) {
    std::filesystem::remove(folder / "dam-changed.json");
    folder.write("hands.txt", row.hands + save);
    const Outcome outcome = view({scene, "--script", "hands.txt", "--screenshot", "end.png", "--view", "particles"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(sizeOf("end.png"), std::pair(1280, 720)) << "the last frame of a script";
    ASSERT_TRUE(std::filesystem::exists(folder / "dam-changed.json")) << row.hands;
    const auto saved = nlohmann::json::parse(contentOf(folder / "dam-changed.json"));
    ASSERT_TRUE(saved["fluid"].contains("viscosity")) << row.hands;
    EXPECT_GE(saved["fluid"]["viscosity"].get<double>(), row.low) << row.hands;
    EXPECT_LE(saved["fluid"]["viscosity"].get<double>(), row.high) << row.hands;
  }
}

TEST_F(ViewWindowTest, UnwritablePictureIsAnError) {
  for (const char* script : {"2 screenshot no-such-folder/a.png\n4 view final\n", "1 minimize\n2 screenshot a.png\n4 restore\n"}) {
    folder.write("hands.txt", script);
    const Outcome outcome = view({scene, "--script", "hands.txt"});
    EXPECT_EQ(outcome.code, 1) << script;
    EXPECT_NE(outcome.err.find("a.png"), std::string::npos) << outcome.err;
  }
}

TEST_F(ViewWindowTest, CyclesThroughScenes) {
  const auto small = [&](const char* name) {
    std::string text = kDam;
    folder.write(name, text.replace(text.find("0.05"), 4, "0.1"));
  };
  small("a.json");
  small("b.json");
  folder.write("broken.json", "{ \"rill\": ");
  folder.write("hands.txt", "1 key ]\n3 key ]\n5 key ]\n7 key ]\n9 key [\n11 drop b.json\n12 drop missing.json\n14 scene a\n");
  const Child::Environment environment{{"RILL_SCENES", folder.string()}};
  const Outcome outcome =
      Child(command({"a", "--view", "particles", "--size", "320x200", "--script", "hands.txt", "--validate"}), folder.string(), environment)
          .wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "") << "an invalid scene is reported in the window";
  EXPECT_EQ(figure(outcome, "scene"), "a");
}

TEST_F(ViewWindowTest, OpensEveryScene) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::path(RILL_SOURCE_DIR) / "assets/scenes"))
    scenes += entry.path().extension() == ".json" && entry.path().filename() != "scene.schema.json" ? 1 : 0;
  std::string script;
  for (int k = 0; k < scenes; ++k) script += std::to_string(2 * k + 1) + " key ]\n";
  folder.write("hands.txt", script + std::to_string(2 * scenes + 2) + " view particles\n");
  const Outcome outcome = view({"box-and-sphere", "--view", "particles", "--size", "320x200", "--script", "hands.txt", "--validate"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(figure(outcome, "scene"), "box-and-sphere") << "one cycle";
}

TEST_F(ViewWindowTest, SignalClosesTheWindow) {
  folder.write("hands.txt", "1 screenshot shown.png\n1000000 view final\n");
  std::vector<std::string> interrupted = onADisplay();
  const std::string view = "echo $$ > pid; exec '" + program() + "' '" + scene + "' --script hands.txt --validate";
  interrupted.insert(interrupted.end(), {"/bin/sh", "-c", view});
  Child child(interrupted, folder.string());
  ASSERT_TRUE(child.waitForFile(folder / "shown.png")) << child.wait().err;
  // Sent once, to the program only: a second one ends it immediately.
  ::kill(std::stoi(contentOf(folder / "pid")), SIGINT);
  const Outcome outcome = child.wait();
  EXPECT_EQ(outcome.code, 130) << "as after any Ctrl-C: " << outcome.err;
  EXPECT_EQ(outcome.err, "");
}

TEST_F(ViewWindowTest, InvalidFileIsReloadedWhenFixed) {
  folder.write("scene.json", "{ \"rill\": \"0.1\", ");
  std::vector<std::string> opened = onADisplay();
  const std::string view = "echo $$ > pid; exec '" + program() + "' scene.json --validate";
  opened.insert(opened.end(), {"/bin/sh", "-c", view});
  Child child(opened, folder.string());
  ASSERT_TRUE(child.waitForMessage("scene.json:1")) << "also reported in the terminal";
  // Two invalid contents before a valid one: the second message shows that the file was read again and that the window is open.
  folder.write("scene.json", "{ \"rill\": \"0.1\", \"fluid\": { \"spacing\": -1 } }");
  folder.write("scene.json", kDam);
  ASSERT_FALSE(child.ended());
  ::kill(std::stoi(contentOf(folder / "pid")), SIGTERM);
  const Outcome outcome = child.wait();
  EXPECT_EQ(outcome.code, 143) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST_F(ViewWindowTest, RejectsBadInputBeforeOpeningAWindow) {
  const Child::Environment nowhere{{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}};
  const auto refused = [&](std::vector<std::string> arguments, const std::string& says) {
    arguments.insert(arguments.begin(), program());
    const Outcome outcome = Child(arguments, folder.string(), nowhere).wait();
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
  };
  refused({scene}, "rill-capture");
  refused({"dam-brake"}, "did you mean \"dam-break\"?");
  refused({scene, "--set", "fluid.viscosity=-1"}, "fluid.viscosity");
  folder.write("broken.json", "{ \"rill\": ");
  refused({(folder / "broken.json").string()}, "broken.json:1");
  folder.write("hands.txt", "0 key P\n1 view nothing\n");
  refused({scene, "--script", "hands.txt"}, "nothing");
  refused({scene, "--script", "no-such-file"}, "no-such-file");
  const Outcome device = view({scene, "--device", "no such device", "--frames", "1"});
  EXPECT_EQ(device.code, 2);
  EXPECT_NE(device.err.find("Available devices:"), std::string::npos) << device.err;
}

}  // namespace
}  // namespace rill::test
