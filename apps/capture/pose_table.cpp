#include "capture/pose_table.hpp"

#include <charconv>
#include <fstream>

#include "core/words.hpp"

namespace rill::capture {
namespace {

constexpr const char* kHeader =
    "frame,time_s,solid,name,x_m,y_m,z_m,qx,qy,qz,qw,vx_m_per_s,vy_m_per_s,vz_m_per_s,wx_rad_per_s,wy_rad_per_s,wz_rad_per_s\r\n";

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string all = "\"";
  for (const char c : text) all += c == '"' ? std::string("\"\"") : std::string(1, c);
  return all + "\"";
}

}  // namespace

PoseTable::PoseTable(const Scene& scene) : scene_(&scene), text_(kHeader) {}

void PoseTable::keep(const std::filesystem::path& file, uint32_t frame) {
  std::ifstream earlier(file, std::ios::binary);
  std::string line;
  if (!std::getline(earlier, line) || line + "\n" != kHeader) return;
  while (std::getline(earlier, line)) {
    uint32_t number = 0;
    if (std::from_chars(line.data(), line.data() + line.size(), number).ec == std::errc() && number >= frame) return;
    text_ += line + "\n";
  }
}

Expected<void> PoseTable::add(uint32_t frame, double time_s, offline::Simulation& simulation) {
  const auto poses = simulation.poses();
  if (!poses) return poses.error();
  for (size_t k = 0; k < poses->size(); ++k) {
    const offline::PoseValue& pose = (*poses)[k];
    text_ += std::to_string(frame) + "," + shortestNumber(time_s) + "," + std::to_string(k) + "," + quoted(scene_->solids[k].name);
    const auto add = [&](const auto& vector) {
      for (const double number : vector) text_ += "," + shortestNumber(number);
    };
    add(pose.position);
    add(pose.rotation);
    add(pose.velocity);
    add(pose.angularVelocity);
    text_ += "\r\n";
  }
  return {};
}

}  // namespace rill::capture
