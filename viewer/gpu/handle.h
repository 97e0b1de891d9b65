// Ownership of OpenGL's objects.
#pragma once
#include <utility>

namespace sdf::viewer {

/// A Handle owns one object of OpenGL and deletes it at its end, which must come while its context is
/// current.
class Handle {
 public:
  using Delete = void (*)(unsigned id);

  Handle() = default;
  Handle(unsigned id, Delete remove) : id_(id), delete_(remove) {}
  /// Owns an object that one of OpenGL's glGen... functions makes.
  Handle(void (*generate)(int count, unsigned* ids), Delete remove) : delete_(remove) { generate(1, &id_); }
  ~Handle() {
    if (id_ != 0) delete_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0u)), delete_(other.delete_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(delete_, other.delete_);
    return *this;
  }
  unsigned id() const { return id_; }

 private:
  unsigned id_ = 0;
  Delete delete_ = nullptr;
};

}  // namespace sdf::viewer
