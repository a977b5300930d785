// Device memory, by what it is for.
#include "view/panels/board.hpp"

namespace rill::view {
namespace {

void line(const char* name, uint64_t bytes) { figureLine(name, "%.1f MiB", static_cast<double>(bytes) / (1 << 20)); }

}  // namespace

void memoryPanel(Board& board) {
  const Runner& runner = board.session.runner();
  const FluidMemory memory = runner.fluid().memory();
  line("particles", memory.particle_bytes);
  line("neighbour list", memory.list_bytes);
  line("grid, at most", memory.grid_bytes);
  line("passes, aliased", runner.transientBytes());
  line("picture's passes, aliased", board.display.transientBytes());
  line("shown picture", board.display.pictureBytes());
}

}  // namespace rill::view
