#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>

namespace rill {

/// Interned names of passes and resources, kept for the graph's lifetime so that later frames allocate nothing.
class Names {
 public:
  uint32_t intern(std::string_view name) {
    if (auto found = index_.find(name); found != index_.end()) return found->second;
    const uint32_t id = uint32_t(entries_.size());
    entries_.push_back({std::string(name), "nothing reads '" + std::string(name) + "'"});
    index_.emplace(entries_.back().name, id);  // a deque never moves its elements
    return id;
  }
  std::string_view operator[](uint32_t id) const { return entries_[id].name; }
  /// The reason for culling a pass whose output of this name is never read.
  std::string_view unread(uint32_t id) const { return entries_[id].unread; }
  size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::string name, unread;
  };
  std::deque<Entry> entries_;
  std::unordered_map<std::string_view, uint32_t> index_;
};

}  // namespace rill
