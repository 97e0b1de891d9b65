#include "sdf/eval/changing_numbers.h"

#include <algorithm>

#include "sdf/expr/alike.h"

namespace sdf {

void ChangingNumbers::begin() {
  outputs_.clear();
  numbers_.clear();
  settled_ = false;
}

void ChangingNumbers::settle() {
  std::vector<std::vector<Expr>> lists = kept_;
  lists.push_back(outputs_);
  const std::vector<Alike> sorts = groupByStructure(lists, "\x02", true);  // no scene's name, and no row's
  const Alike& own = *std::ranges::find(sorts, kept_.size(), [](const Alike& a) { return a.places.back(); });
  form_ = own.common;
  place_ = own.places.front();
  for (std::size_t i = 0; i < own.parameters.size(); ++i)
    numbers_.emplace(own.parameters[i], own.rows.back()[i]);
  settled_ = true;
  taken_ = 0;
}

void ChangingNumbers::keep() {
  constexpr std::size_t kMost = 8;  // structures; more are made anew when they return
  if (place_ == kept_.size())
    kept_.push_back(form_);
  else
    kept_[place_] = form_;
  if (kept_.size() > kMost) kept_.erase(kept_.begin());
}

std::vector<Expr> ChangingNumbers::take(std::span<const Expr> outputs) {
  if (!settled_) {
    outputs_.insert(outputs_.end(), outputs.begin(), outputs.end());
    return {outputs.begin(), outputs.end()};
  }
  const auto first = form_.begin() + static_cast<std::ptrdiff_t>(taken_);
  taken_ += outputs.size();
  return {first, first + static_cast<std::ptrdiff_t>(outputs.size())};
}

Expr ChangingNumbers::now(const Expr& part) const {
  return rewrite(part, [&](const Expr& e, std::span<const Expr>) {
    const auto found = numbers_.find(e);
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  });
}

}  // namespace sdf
