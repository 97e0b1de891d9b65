// A hash table that allocates rarely.
#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sdf {

/// Maps numbers (or addresses) to small values in one array, by open addressing. Nothing can be taken out.
template <class Value>
class FlatMap {
 public:
  /// The key's value, which is this one if the key is new; and whether it is.
  std::pair<Value&, bool> insert(std::uint64_t key, const Value& value) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    Slot& slot = slotOf(slots_, key);
    const bool fresh = !slot.used;
    if (fresh) slot = {key, value, true}, ++size_;
    return {slot.value, fresh};
  }
  std::pair<Value&, bool> insert(const void* key, const Value& value) {
    return insert(reinterpret_cast<std::uintptr_t>(key), value);
  }
  /// Precondition: the key is there.
  const Value& at(const void* key) const {
    return slotOf(slots_, reinterpret_cast<std::uintptr_t>(key)).value;
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    Value value{};
    bool used = false;
  };
  static constexpr std::size_t kFirstSize = 64;  // a power of two, as all sizes

  // The key's slot, or the free one that it would get. Addresses differ little in their last bits; the
  // product (Knuth's multiplicative hashing) mixes them into the upper ones.
  template <class Slots>
  static auto& slotOf(Slots& slots, std::uint64_t key) {
    constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ull;
    std::size_t i = (key * kGolden >> 32) & (slots.size() - 1);
    while (slots[i].used && slots[i].key != key) i = (i + 1) & (slots.size() - 1);
    return slots[i];
  }
  void grow() {
    std::vector<Slot> larger(slots_.empty() ? kFirstSize : 2 * slots_.size());
    for (const Slot& s : slots_)
      if (s.used) slotOf(larger, s.key) = s;
    slots_ = std::move(larger);
  }

  std::vector<Slot> slots_;
  std::size_t size_ = 0;
};

}  // namespace sdf
