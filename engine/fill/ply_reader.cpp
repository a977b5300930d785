#include "fill/ply_reader.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include "core/numbers.hpp"
#include "core/shares.hpp"
#include "core/words.hpp"
#include "fill/ply_format.hpp"
#include "rill/scene.hpp"

namespace rill {

constexpr size_t kFirstConcentration = 7;
constexpr double kConcentrationSlack = 1e-3;  // rounding of what a run writes

struct PlyFile::Header : ply::Header {
  /// Indices of x y z vx vy vz fluid, and of concentrations, among the properties of a vertex; -1: missing, or not read.
  std::vector<int> column = {};
  size_t fluids = 0;
  std::vector<size_t> diffusing = {};

  bool hasVelocity() const { return column[3] >= 0 && column[4] >= 0 && column[5] >= 0; }
  bool hasFluid() const { return column[6] >= 0; }
  bool hasConcentrations() const {
    return std::ranges::any_of(std::span(column).subspan(kFirstConcentration), [](int k) { return k >= 0; });
  }
};

PlyFile::PlyFile(std::unique_ptr<Header> header) : header_(std::move(header)) {}
PlyFile::PlyFile(PlyFile&&) noexcept = default;
PlyFile& PlyFile::operator=(PlyFile&&) noexcept = default;
PlyFile::~PlyFile() = default;

uint64_t PlyFile::count() const { return header_->elements.back().count; }

Expected<PlyFile> PlyFile::open(const std::filesystem::path& file, size_t fluids, std::span<const size_t> diffusing) {
  assert(diffusing.size() <= kMaxDiffusing && (diffusing.empty() || fluids > 0));
  std::vector<std::string> shares;
  for (const size_t fluid : diffusing) shares.push_back("concentration" + std::to_string(fluid));
  std::vector<std::string_view> names{"x", "y", "z", "vx", "vy", "vz", "fluid"};
  names.insert(names.end(), shares.begin(), shares.end());
  auto read = ply::readHeader(file, "vertex");
  if (!read) return read.error();
  auto header = std::make_unique<Header>(Header{std::move(*read), {}, fluids, {diffusing.begin(), diffusing.end()}});
  if (header->elements.empty() || header->elements.back().name != "vertex")
    return header->badInput("the header has no vertex element; expected one with x, y and z");
  header->column.resize(names.size(), -1);
  const size_t columns = fluids > 0 ? names.size() : kFirstConcentration - 1;
  if (auto ok = header->findColumns(header->elements.back(), std::span(names).first(columns), std::span(header->column).first(columns));
      !ok)
    return ok.error();
  if (auto ok = header->checkCounts(); !ok) return ok.error();
  return PlyFile(std::move(header));
}

Expected<PlyParticles> PlyFile::read() const {
  const Header& header = *header_;
  ply::Body body(header);
  if (!body.isOpen()) return header.badInput("cannot be read");
  PlyParticles out;
  std::vector<double> row;
  for (const ply::Element& element : header.elements) {
    const bool vertex = element.name == "vertex";
    if (element.properties.empty()) continue;
    if (vertex) out.positions.reserve(element.count);
    if (vertex && header.hasVelocity()) out.velocities.reserve(element.count);
    if (vertex && header.hasFluid()) out.fluids.reserve(element.count);
    if (vertex && header.hasConcentrations()) out.concentrations.reserve(element.count);
    for (uint64_t i = 0; i < element.count; ++i) {
      if (auto ok = body.read(element, i, row); !ok) return ok.error();
      if (!vertex) continue;
      const auto at = [&](size_t k) { return row[static_cast<size_t>(header.column[k])]; };
      std::array<double, 6> motion{};
      const size_t given = header.hasVelocity() ? 6 : 3;
      for (size_t k = 0; k < given; ++k) motion[k] = at(k);
      if (auto ok = header.checkMotion(i, std::span(motion).first(given)); !ok) return ok.error();
      out.positions.push_back({at(0), at(1), at(2)});
      if (header.hasVelocity()) out.velocities.push_back({static_cast<float>(at(3)), static_cast<float>(at(4)), static_cast<float>(at(5))});
      if (header.hasFluid()) {
        const double fluid = at(6);
        if (!(fluid >= 0 && fluid < static_cast<double>(header.fluids)) || fluid != std::floor(fluid)) {
          return header.badInput("vertex " + grouped(i) + ", property \"fluid\": found " + shortestNumber(fluid) +
                                 ", expected the index of one of the scene's fluids, a whole number from 0 to " +
                                 std::to_string(header.fluids - 1));
        }
        out.fluids.push_back(static_cast<uint8_t>(fluid));
      }
      if (!header.hasConcentrations()) continue;
      Float4& all =
          out.concentrations.emplace_back(unmixed(std::span<const size_t>(header.diffusing), header.hasFluid() ? out.fluids.back() : 0));
      for (size_t k = 0; k < header.diffusing.size(); ++k) {
        const int column = header.column[kFirstConcentration + k];
        if (column < 0) continue;
        const double share = row[static_cast<size_t>(column)];
        if (!(std::abs(share - 0.5) <= 0.5 + kConcentrationSlack))
          return header.badInput("vertex " + grouped(i) + ", property \"concentration" + std::to_string(header.diffusing[k]) +
                                 "\": found " + shortestNumber(share) + ", expected a number from 0 to 1");
        all.*kShares[k] = static_cast<float>(std::clamp(share, 0.0, 1.0));
      }
    }
  }
  return out;
}

}  // namespace rill
