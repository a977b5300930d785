#include "sort/rig.hpp"

#include <algorithm>
#include <cassert>
#include <deque>
#include <numeric>
#include <stdexcept>

namespace rill::test {

WordBuffer::WordBuffer(Device& owner, size_t count, uint32_t filling) : count_(count) {
  auto made = createBuffer(owner, "test words", paddedWords(std::max<size_t>(count, 1)) * sizeof(uint32_t), MemoryKind::Readback);
  if (!made) throw std::runtime_error(made.error().message);
  buffer_ = *std::move(made);
  std::ranges::fill(words(), filling);
}

WordBuffer::WordBuffer(Device& owner, std::span<const uint32_t> words) : WordBuffer(owner, words.size()) {
  std::ranges::copy(words, this->words().begin());
}

BufferRef WordBuffer::in(Graph& graph, std::string_view name) const {
  return graph.import(name, {.handle = buffer_.handle(), .size = buffer_.size(), .before = Use::Unknown, .after = Use::HostRead});
}

Sorted expected(std::span<const uint32_t> keys, uint64_t keyRange, bool withStart) {
  Sorted result;
  result.order.resize(keys.size());
  std::iota(result.order.begin(), result.order.end(), 0u);
  std::ranges::stable_sort(result.order, {}, [&](uint32_t index) { return keys[index]; });
  for (uint32_t index : result.order) result.keys.push_back(keys[index]);
  if (withStart) {
    uint32_t slot = 0;
    for (uint64_t key = 0; key <= keyRange; ++key) {
      while (slot < keys.size() && result.keys[slot] < key) ++slot;
      result.start.push_back(slot);
    }
  }
  return result;
}

void SortTest::runGraphs(const std::vector<Declare>& declares) {
  std::deque<Graph> graphs;
  for (const Declare& declare : declares) {
    Graph& graph = graphs.emplace_back();
    declare(graph);
    auto ok = graph.compile();
    if (ok) ok = graph.prepare(device());
    ASSERT_TRUE(ok) << ok.error().message;
  }
  auto ok = context().submit([&](VkCommandBuffer commands) {
    for (Graph& graph : graphs) graph.record(commands);
  });
  if (ok) ok = context().wait();
  ASSERT_TRUE(ok) << ok.error().message;
}

Sorted SortTest::sorted(const KeySortDesc& desc, const Words& keys) {
  assert(desc.count == keys.size());
  auto sort = KeySort::create(device(), desc);
  if (!sort) throw std::runtime_error(sort.error().message);
  const WordBuffer input = words(keys), order = words(keys.size(), ~0u), start = words(desc.start ? desc.keyRange + 1 : 0, ~0u),
                   sortedKeys = words(desc.keys ? keys.size() : 0, ~0u);
  runGraph([&](Graph& graph) {
    SortTargets targets{.order = order.in(graph, "order")};
    if (desc.start) targets.start = start.in(graph, "start");
    if (desc.keys) targets.keys = sortedKeys.in(graph, "sorted keys");
    sort->addTo(graph, input.in(graph, "keys"), targets);
  });
  return {order.copy(), start.copy(), sortedKeys.copy()};
}

}  // namespace rill::test
