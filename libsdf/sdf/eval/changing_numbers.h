// What the functions of a scene's shaders have in common at several moments.
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "sdf/expr/expr.h"
#include "sdf/expr/payload.h"

namespace sdf {

/// A scene that is made anew for other values of its parameters has the same functions as before but for
/// numbers, such as slopes. ChangingNumbers finds out which numbers differ and puts parameters in their
/// places (expr/alike.h), so that the same text serves all moments. Payloads of one kind serve one another's
/// moments, too. A scene's functions are handed over twice, in the same order: between begin() and settle()
/// to be compared, and after settle() to be written.
class ChangingNumbers {
 public:
  void begin();
  /// Compares the functions since begin() with those that are kept. Cost: linear in the size of their graphs.
  void settle();
  /// Keeps the form that is written: what differs from now on differs from this, too.
  void keep();

  bool isSettled() const { return settled_; }
  /// Returns the outputs of a function in the form to be written; before settle() as they are.
  std::vector<Expr> take(std::span<const Expr> outputs);
  /// Return what stands at present for a part of that form which does not depend on space, and for a payload.
  Expr now(const Expr& part) const;
  std::shared_ptr<const Payload> now(const std::shared_ptr<const Payload>& payload) const;

 private:
  std::shared_ptr<const Payload> standInFor(const std::shared_ptr<const Payload>& payload);

  std::vector<std::vector<Expr>> kept_;  // forms of different structures, of all functions in a row
  std::vector<Expr> outputs_, form_;
  std::size_t place_ = 0;  // of the form among those kept; the next one: of a new structure
  std::size_t taken_ = 0;
  bool settled_ = false;
  std::unordered_map<Expr, Expr> numbers_;                // by parameter of the form
  std::vector<std::shared_ptr<const Payload>> standIns_;  // for payloads that have a kind, in the order met
  std::vector<std::shared_ptr<const Payload>> payloads_;  // for which they stand
};

}  // namespace sdf
