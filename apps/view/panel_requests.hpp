#pragma once
#include "view/device_change.hpp"
#include "view/panels/board.hpp"
#include "view/scene_list.hpp"
#include "view/shown_scene.hpp"

namespace rill::view {

/// Carries out what the panels request in a frame. Returns errors that end the program.
Expected<void> carryOut(const Requests& requests, Graphics& graphics, ShownScene& shown, SceneList& scenes, DeviceChange& devices,
                        MessageBox& message);

}  // namespace rill::view
