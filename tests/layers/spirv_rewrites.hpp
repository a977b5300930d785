// What a conforming driver may do to a shader, taken to the extreme: each function returns a module that a shader written by the
// specification computes the same with, up to rounding.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace rill::layer {

/// Denormal floats are zeros: those fetched, made from bits, taken as bits or computed (Vulkan 1.3, "Precision and Operation of SPIR-V
/// Instructions"); so are denormal halves, packed and unpacked.
std::vector<uint32_t> flushDenormals(std::span<const uint32_t> words);

/// Neither operands nor results are NaN or infinite, so that ordered and unordered comparisons are each other's, comparisons with
/// infinity have one outcome, minima, maxima and clamps of NaN are NaN, and x - x and 0 * x are 0.
std::vector<uint32_t> assumeFinite(std::span<const uint32_t> words);

/// Products, quotients and results of built-in functions differ by a unit in the last place where they are not `precise`, quotients by up
/// to two: up or down or not at all, by the shader's arithmetic, the instruction and the seed. A product stands for what contraction into a
/// sum does to it.
std::vector<uint32_t> perturbRounding(std::span<const uint32_t> words, uint32_t seed);

/// A shuffle from a lane that is not active gives garbage: NaN, or 0xdeadbeef.
std::vector<uint32_t> poisonShuffles(std::span<const uint32_t> words);

/// Workgroups are permuted: group g of n does the work of group (g * odd + seed) % n.
std::vector<uint32_t> permuteWorkgroups(std::span<const uint32_t> words, uint32_t seed);

/// Headers of loops hold nothing but their merge instruction: the packaged validation layer (1.3.239) splits the block of each access
/// that it checks, and a loop header that was split is not a valid loop header.
std::vector<uint32_t> splitLoopHeaders(std::span<const uint32_t> words);

}  // namespace rill::layer
