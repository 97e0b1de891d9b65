#include "sdf/eval/changing_numbers.h"

#include <algorithm>
#include <limits>

#include "sdf/expr/alike.h"

namespace sdf {
namespace {

// Any payload of a kind: where a form has it, each moment has its own.
class StandIn : public Payload {
 public:
  double value(const glm::dvec3&) const override { return kUnknown; }
  ValueAndGradient gradient(const glm::dvec3&) const override { return {kUnknown, glm::dvec3(kUnknown)}; }
  Interval range(const std::array<Interval, 3>&) const override { return Interval::everything(); }
  double lipschitz() const override { return std::numeric_limits<double>::infinity(); }
  double rounding(const glm::dvec3&) const override { return std::numeric_limits<double>::infinity(); }
  std::string glsl(const std::string&) const override { return {}; }

 private:
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace

void ChangingNumbers::begin() {
  outputs_.clear();
  numbers_.clear();
  payloads_.clear();
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
    const auto form = rewrite(outputs, [&](const Expr& e, std::span<const Expr> args) -> std::optional<Expr> {
      const PayloadPart* const p = e.payloadPart();
      if (!p || p->payload->kind().empty()) return {};
      return Expr::payload({standInFor(p->payload), p->part}, {args[0], args[1], args[2]});
    });
    outputs_.insert(outputs_.end(), form.begin(), form.end());
    return {outputs.begin(), outputs.end()};
  }
  const auto first = form_.begin() + static_cast<std::ptrdiff_t>(taken_);
  taken_ += outputs.size();
  return {first, first + static_cast<std::ptrdiff_t>(outputs.size())};
}

std::shared_ptr<const Payload> ChangingNumbers::standInFor(const std::shared_ptr<const Payload>& payload) {
  const auto place = static_cast<std::size_t>(std::ranges::find(payloads_, payload) - payloads_.begin());
  if (place == payloads_.size()) payloads_.push_back(payload);
  if (place == standIns_.size()) standIns_.push_back(std::make_shared<StandIn>());
  return standIns_[place];
}

std::shared_ptr<const Payload> ChangingNumbers::now(const std::shared_ptr<const Payload>& payload) const {
  const auto place = static_cast<std::size_t>(std::ranges::find(standIns_, payload) - standIns_.begin());
  return place < payloads_.size() ? payloads_[place] : payload;
}

Expr ChangingNumbers::now(const Expr& part) const {
  return rewrite(part, [&](const Expr& e, std::span<const Expr>) {
    const auto found = numbers_.find(e);
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  });
}

}  // namespace sdf
