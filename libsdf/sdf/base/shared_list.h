// A list whose copies share their items, and which grows at its end.
#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace sdf {

/// Counts nothing; see SharedList.
struct NoTally {
  explicit NoTally(std::size_t /*capacity*/) {}
};

/// A list as a value: copies take no time, and what is added to one is not seen in the others. The items are
/// kept in blocks with room at the end. The first copy that is added to takes that room, others move to a
/// block of their own, so that n additions, each to a copy of the last list, take the time and the room of
/// some 2 n items. Copies may be read and added to by any thread. A block keeps a Tally, made from how many
/// items it has room for, as long as it lives.
template <class T, class Tally = NoTally>
class SharedList {
 public:
  SharedList() = default;

  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  const T& front() const { return data_[0]; }

  /// Makes room for so many in all.
  void reserve(std::size_t capacity) {
    if (capacity > room()) moveTo(capacity);
  }

  void push_back(T item) {
    if (!pushedInPlace(item)) {
      moveTo(std::max<std::size_t>(2 * size_, 2));
      pushedInPlace(item);
    }
  }

  void append(std::span<const T> items) {
    if (const std::size_t needed = size_ + items.size(); needed > room()) moveTo(std::max(2 * size_, needed));
    for (const T& item : items) push_back(item);
  }

 private:
  struct Block {
    explicit Block(std::size_t capacity) : tally(capacity) { items.reserve(capacity); }
    Tally tally;
    std::mutex mutex;
    std::vector<T> items;
  };

  std::size_t room() const { return block_ ? block_->items.capacity() : 0; }

  // Adds behind the list's own items, if nobody else has: others of the block's lists end before.
  bool pushedInPlace(T& item) {
    if (!block_) return false;
    const std::lock_guard lock(block_->mutex);
    if (block_->items.size() != size_ || size_ == block_->items.capacity()) return false;
    block_->items.push_back(std::move(item));
    ++size_;
    return true;
  }

  void moveTo(std::size_t capacity) {
    auto block = std::make_shared<Block>(capacity);
    block->items.assign(begin(), end());
    block_ = std::move(block);
    data_ = block_->items.data();
  }

  std::shared_ptr<Block> block_;
  const T* data_ = nullptr;  // the block's, which stay where they are
  std::size_t size_ = 0;
};

}  // namespace sdf
