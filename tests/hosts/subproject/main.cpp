#include <rill/fluid_renderer.hpp>
#include <rill/version.hpp>

int main() { return rill::fluidLook("water") && *rill::version() ? 0 : 1; }
