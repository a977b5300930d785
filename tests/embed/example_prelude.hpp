#pragma once
// Declarations of a host that the guide and the examples in the headers assume.
#include <vulkan/vulkan.h>

#include <cstdio>
#include <rill/fluid.hpp>
#include <rill/graph.hpp>
#include <rill/particles.hpp>
#include <rill/scene.hpp>
#include <string_view>

extern VkInstance instance;
extern VkPhysicalDevice physicalDevice;
extern VkDevice vkDevice;
extern VkDeviceCreateInfo deviceInfo;
extern VkPipelineCache pipelineCache;
extern VkCommandBuffer commandBuffer;
extern VkImage colorImage, depthImage;
extern VkBuffer positionBuffer;
extern uint32_t queueFamily, width, height, particleCount;
extern uint64_t frameNumber, lastFinishedFrame;
extern const float *viewMatrix, *projectionMatrix;
int fail(std::string_view message);

// For headers whose examples need a device.
extern rill::Device& device;
extern rill::Graph& graph;
extern rill::FluidState state;
extern rill::Scene scene;
extern rill::ParticleSet particles;
extern rill::Fluid water;
void run(rill::Graph& graph);
