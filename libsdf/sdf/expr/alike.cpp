#include "sdf/expr/alike.h"

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>

#include "sdf/expr/payload.h"

namespace sdf {
namespace {

using Nodes = std::vector<Expr>;

struct ByNode {
  bool operator()(const Nodes& a, const Nodes& b) const {
    return std::ranges::lexicographical_compare(a, b, std::less<const Node*>(), &Expr::node, &Expr::node);
  }
};

/// Numbers what expressions are but for numbers. Sharing within one does not matter: two of its terms may be
/// the same by chance.
class Forms {
 public:
  static constexpr std::size_t kNumber = 0;

  std::size_t of(const Expr& root) {
    for (const Expr& e : topologicalOrder({&root, 1}))
      if (!forms_.contains(e)) forms_.emplace(e, formOf(e));
    return forms_.at(root);
  }

 private:
  std::size_t formOf(const Expr& e) {
    std::vector<std::size_t> parts;
    for (int i = 0; i < arity(e.op()); ++i) parts.push_back(forms_.at(e.arg(i)));
    const bool isNumber = std::ranges::all_of(parts, [](std::size_t form) { return form == kNumber; });
    const bool isOwn = e.op() == Op::Parameter && e.parameterInfo().name.front() == kOwnName;
    if (isNumber && e.op() != Op::Variable && !isOwn) return kNumber;
    parts.push_back(static_cast<std::size_t>(e.op()));
    if (isOwn) parts.push_back(owns_.try_emplace(e.parameterInfo().name, owns_.size()).first->second);
    if (e.op() == Op::Variable) parts.push_back(static_cast<std::size_t>(e.variableIndex()));
    if (const PayloadPart* p = e.payloadPart()) {
      const std::size_t place = payloads_.try_emplace(p->payload.get(), payloads_.size()).first->second;
      parts.insert(parts.end(), {place, static_cast<std::size_t>(p->part)});
    }
    return known_.try_emplace(parts, known_.size() + 1).first->second;
  }

  std::unordered_map<Expr, std::size_t> forms_;
  std::map<std::vector<std::size_t>, std::size_t> known_;
  std::unordered_map<const Payload*, std::size_t> payloads_;
  std::unordered_map<std::string, std::size_t> owns_;  // parameters
};

/// Finds what expressions of one form have in common, node by node.
class Joining {
 public:
  Joining(Forms& forms, const std::string& prefix, std::size_t& count, bool asFloats)
      : forms_(forms), prefix_(prefix), count_(count), asFloats_(asFloats) {}

  Expr joined(const Nodes& roots) {
    std::vector<Nodes> open{roots};
    while (!open.empty()) {
      const Nodes nodes = open.back();
      const std::size_t before = open.size();
      if (!made_.contains(nodes)) {
        const std::optional<Expr> e = made(nodes, open);
        if (!e) continue;
        made_.emplace(nodes, *e);
      }
      open.resize(before - 1);
    }
    return made_.find(roots)->second;
  }

  std::vector<Expr> parameters;
  std::vector<Nodes> numbers;  // by parameter

 private:
  bool isOne(const Expr& a, const Expr& b) const {
    return a == b || (asFloats_ && a.isConstant() && b.isConstant() &&
                      static_cast<float>(a.constantValue()) == static_cast<float>(b.constantValue()));
  }

  // What stands for these nodes; nothing, if first what is put on the list must be made.
  std::optional<Expr> made(const Nodes& nodes, std::vector<Nodes>& open) {
    const Expr& first = nodes.front();
    if (std::ranges::all_of(nodes, [&](const Expr& e) { return isOne(e, first); })) return first;
    if (forms_.of(first) == Forms::kNumber) {
      parameters.push_back(numberAmong(prefix_ + std::to_string(count_++), nodes));
      numbers.push_back(nodes);
      return parameters.back();
    }
    if (first.op() == Op::Parameter) return first;  // an own one, which may be meant for another range
    std::vector<Expr> args;
    for (int i = 0; i < arity(first.op()); ++i) {
      Nodes parts;
      for (const Expr& e : nodes) parts.push_back(e.arg(i));
      const auto known = made_.find(parts);
      if (known == made_.end())
        open.push_back(std::move(parts));
      else
        args.push_back(known->second);
    }
    if (args.size() < static_cast<std::size_t>(arity(first.op()))) return std::nullopt;
    if (const PayloadPart* p = first.payloadPart()) return Expr::payload(*p, {args[0], args[1], args[2]});
    return Expr::make(first.op(), args);
  }

  Forms& forms_;
  const std::string& prefix_;
  std::size_t& count_;
  bool asFloats_;
  std::map<Nodes, Expr, ByNode> made_;
};

}  // namespace

Expr numberAmong(const std::string& name, std::span<const Expr> numbers) {
  Interval all = numbers.front().range();
  for (const Expr& e : numbers) all = hull(all, e.range());
  return Expr::parameter({name, all.lo, all.lo, all.hi});
}

std::vector<Alike> groupByStructure(std::span<const std::vector<Expr>> lists, const std::string& prefix,
                                    bool asFloats) {
  Forms forms;
  std::vector<Nodes> roots;
  std::map<std::vector<std::size_t>, std::size_t> sorts;
  std::vector<Alike> result;
  for (const std::vector<Expr>& list : lists) {
    roots.push_back(withoutClaims(list));
    std::vector<std::size_t> form;
    for (const Expr& e : roots.back()) form.push_back(forms.of(e));
    const auto [sort, isNew] = sorts.try_emplace(form, result.size());
    if (isNew) result.emplace_back();
    result[sort->second].places.push_back(roots.size() - 1);
  }
  std::size_t count = 0;
  for (Alike& alike : result) {
    Joining joining(forms, prefix, count, asFloats);
    for (std::size_t i = 0; i < roots[alike.places.front()].size(); ++i) {
      Nodes nodes;
      for (const std::size_t place : alike.places) nodes.push_back(roots[place][i]);
      alike.common.push_back(joining.joined(nodes));
    }
    alike.parameters = joining.parameters;
    alike.rows.resize(alike.places.size());
    for (std::size_t list = 0; list < alike.places.size(); ++list)
      for (const Nodes& numbers : joining.numbers) alike.rows[list].push_back(numbers[list]);
  }
  return result;
}

std::size_t operationsOf(std::span<const Expr> expressions) {
  const auto isOne = [](const Expr& e) { return arity(e.op()) > 0; };
  return static_cast<std::size_t>(std::ranges::count_if(topologicalOrder(expressions), isOne));
}

}  // namespace sdf
