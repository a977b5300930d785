// A host that uses Vulkan incorrectly, without Rill: proves that the validation layer is active for the other hosts.
#include "host/engine.hpp"

int main() {
  host::Engine engine([](VkInstance, VkPhysicalDevice) -> const void* { return nullptr; });
  host::Buffer buffer = engine.createBuffer(256, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  const host::Frame frame = engine.begin();
  vkCmdFillBuffer(frame.commands, buffer.handle, 0, 256, 1);
  vkCmdFillBuffer(frame.commands, buffer.handle, 0, 256, 2);  // no barrier between
  vkCmdFillBuffer(frame.commands, buffer.handle, 3, 4, 2);    // not a multiple of 4
  engine.end(frame);
  engine.wait();
  engine.destroy(buffer);
}
