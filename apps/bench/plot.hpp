#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "bench/report.hpp"
#include "rill/expected.hpp"

namespace rill::bench {

/// BadInput, with what to install, where there is no gnuplot to draw with.
Expected<void> checkPlotter();

/// The gnuplot program that draws `plots` beside and below each other as one SVG on its standard output.
std::string plotProgram(std::span<const Plot> plots);

/// Draws `plots` into an SVG file, written whole or not at all. Io, naming the file and what gnuplot said.
Expected<void> writePlots(const std::filesystem::path& file, std::span<const Plot> plots);

}  // namespace rill::bench
