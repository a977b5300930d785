#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "bench/report.hpp"
#include "rill/expected.hpp"

namespace rill::bench {

/// BadInput if gnuplot is not installed; the message names the package to install.
Expected<void> checkPlotter();

/// A gnuplot script that draws `plots` in a grid as one SVG on standard output.
std::string plotProgram(std::span<const Plot> plots);

/// Draws `plots` into an SVG file, written atomically. Io with the file's name and gnuplot's message.
Expected<void> writePlots(const std::filesystem::path& file, std::span<const Plot> plots);

}  // namespace rill::bench
