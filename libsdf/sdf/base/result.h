// Errors as values. A function that can fail on its input returns Result<T>; broken contracts assert.
#pragma once
#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace sdf {

/// What kind of input was wrong. The programs turn it into their exit code.
enum class ErrorKind {
  Usage = 2,         ///< the command line, or an argument of a function
  Scene = 3,         ///< the scene's script, or one of its shapes
  Limits = 4,        ///< more memory, space in a file or accuracy is asked for than there is
  Files = 5,         ///< a file cannot be read or written
  Graphics = 6,      ///< there is no OpenGL context, or the driver refuses its work
  Interrupted = 130  ///< the user ended the work
};

/// One line for the user: what is wrong, where, and what to do.
struct Error {
  ErrorKind kind;
  std::string message;
};

/// Either a T or the Error that stood in its way.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}      // NOLINT: implicit by design
  Result(Error error) : state_(std::move(error)) {}  // NOLINT
  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }
  T& value() & {
    assert(ok());
    return std::get<0>(state_);
  }
  const T& value() const& {
    assert(ok());
    return std::get<0>(state_);
  }
  T&& value() && {
    assert(ok());
    return std::get<0>(std::move(state_));
  }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  const Error& error() const {
    assert(!ok());
    return std::get<1>(state_);
  }

 private:
  std::variant<T, Error> state_;
};

/// Result of something that yields no value.
using Status = Result<std::monostate>;
inline Status okStatus() { return std::monostate{}; }

/// Moves the result's value to its place, or returns the error that stood in its way.
template <class T, class Place>
Status keep(Result<T> result, Place& place) {
  if (!result) return result.error();
  place = std::move(*result);
  return okStatus();
}

}  // namespace sdf
