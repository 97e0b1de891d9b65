#include "sdf/eval/glsl.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "sdf/expr/payload.h"

namespace sdf {
namespace {

constexpr const char* kVariables[kVariableCount] = {"p.x", "p.y", "p.z", "n.x", "n.y", "n.z"};
constexpr const char* kComponents = "xyzw";
constexpr const char* kPayload = "sdfPayload";  // and its place

// What GLSL leaves undefined, defined as in number/scalar.h; and arcs by atan, for Mesa's own are off by
// 4e-4.
const std::map<std::string, std::string> kHelpers = {
    {"sdfPow", R"(float sdfPow(float a, float b) {
  if (b == 0.0) return 1.0;
  if (a > 0.0) return pow(a, b);
  if (a == 0.0) return b > 0.0 ? 0.0 : uintBitsToFloat(0x7f800000u);
  float magnitude = pow(-a, b);
  if (b != floor(b)) return uintBitsToFloat(0x7fc00000u);
  return mod(b, 2.0) == 0.0 ? magnitude : -magnitude;
}
)"},
    {"sdfAtan2", R"(float sdfAtan2(float y, float x) {
  return x == 0.0 && y == 0.0 ? 0.0 : atan(y, x);
}
)"},
    {"sdfAsin", R"(float sdfAsin(float a) {
  float b = sqrt((1.0 - a) * (1.0 + a));
  return abs(a) <= 1.0 ? atan(a, b) : uintBitsToFloat(0x7fc00000u);
}
)"},
    {"sdfAcos", R"(float sdfAcos(float a) {
  float b = sqrt((1.0 - a) * (1.0 + a));
  return abs(a) <= 1.0 ? atan(b, a) : uintBitsToFloat(0x7fc00000u);
}
)"},
};

// Doubles have no sine in GLSL. Less whole half turns, of which an odd one changes the sign; then Taylor's
// series, which is 4e-18 off at pi / 2.
constexpr const char* kExactSine = R"(double sdfSin(double a) {
  double turns = roundEven(a * 0.31830988618379067lf);
  double x = (a - turns * 3.1415926535897931lf) - turns * 1.2246467991473532e-16lf, s = x * x;
  double sum = 1.0lf;
  for (double k = 22.0lf; k > 1.0lf; k -= 2.0lf) sum = 1.0lf - s / (k * (k + 1.0lf)) * sum;
  return mod(turns, 2.0lf) == 0.0lf ? x * sum : -x * sum;
}
double sdfCos(double a) { return sdfSin(a + 1.5707963267948966lf); }

)";

// How the operation is written for doubles; empty where it takes floats only.
std::string exactTerm(Op op) {
  switch (op) {
    case Op::Sin:
      return "sdfSin($0)";
    case Op::Cos:
      return "sdfCos($0)";
    case Op::Less:
      return "double($0 < $1)";
    case Op::LessEqual:
      return "double($0 <= $1)";
    case Op::Equal:
      return "double($0 == $1)";
    case Op::Tan:
    case Op::Asin:
    case Op::Acos:
    case Op::Atan:
    case Op::Atan2:
    case Op::Exp:
    case Op::Log:
    case Op::Pow:
      return "";
    default:
      return isOperation(op) ? std::string(info(op).glsl) : "";
  }
}

std::string exactLiteral(double value) {
  if (!std::isfinite(value))
    return "double(" +
           (std::isnan(value) ? std::string("0.0/0.0")
            : value > 0       ? "1.0/0.0"
                              : "-1.0/0.0") +
           ")";
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  std::string s = text;
  if (s.find_first_of(".e") == std::string::npos) s += ".0";
  return "(" + s + "lf)";
}

std::string literal(double value) {
  const auto v = static_cast<float>(value);
  if (std::isnan(v)) return "uintBitsToFloat(0x7fc00000u)";
  if (std::isinf(v)) return v > 0 ? "uintBitsToFloat(0x7f800000u)" : "uintBitsToFloat(0xff800000u)";
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", v);
  std::string s = text;
  if (s.find_first_of(".e") == std::string::npos) s += ".0";
  return v < 0 || std::signbit(v) ? "(" + s + ")" : s;
}

}  // namespace

bool canBeExact(const Expr& e) { return !exactTerm(e.op()).empty(); }

/// Writes the body of one function: a line for each node that depends on space, those that are used once
/// within the line that uses them.
class GlslWriter::Body {
 public:
  explicit Body(GlslWriter& writer) : writer_(writer) {}

  void write(std::span<const Expr> outputs) {
    const std::vector<Expr> order = topologicalOrder(outputs);
    for (const Expr& e : order) {
      const std::string_view term = info(e.op()).glsl;
      const bool twice = term.find("$0") != term.rfind("$0");
      for (int i = 0; i < arity(e.op()); ++i) uses_[e.arg(i)] += twice ? 2 : 1;
    }
    for (const Expr& e : outputs) ++uses_[e];
    for (const Expr& e : order) {
      if (!inSpace(e)) continue;
      if (e.op() == Op::Variable) {
        names_[e] = kVariables[static_cast<int>(e.variableIndex())];
      } else if (e.op() == Op::Claim) {
        names_[e] = name(e.arg(0));
      } else if (e.op() == Op::Parameter) {
        names_[e] = writer_.terms_.at(e.parameterInfo().name);
      } else if (isExact(e)) {
        std::string name = "d" + std::to_string(lines_++);
        body_ += "  double " + name + " = " + exactOperation(e) + ";" + writer_.commentOf(e) + "\n";
        names_[e] = "float(" + name + ")";
        exactNames_[e] = std::move(name);
      } else {
        std::string term = e.payloadPart() ? payload(e, *e.payloadPart()) : operation(e);
        if (uses_.at(e) == 1 && !e.payloadPart() && term.size() < kLongLine &&
            !writer_.labelled_.contains(e)) {
          names_[e] = isCall(e.op()) ? std::move(term) : "(" + term + ")";
          continue;
        }
        std::string name = "v" + std::to_string(lines_++);
        body_ += "  float " + name + " = " + term + ";" + writer_.commentOf(e) + "\n";
        names_[e] = std::move(name);
      }
    }
  }

  const std::string& body() const { return body_; }

  std::string name(const Expr& e) {
    if (e.isConstant()) return literal(e.constantValue());
    const auto found = names_.find(e);
    return found == names_.end() ? writer_.uniform(e) : found->second;
  }

 private:
  static constexpr std::size_t kLongLine = 100;

  // A term that needs no parentheses within another one.
  static bool isCall(Op op) { return std::isalpha(static_cast<unsigned char>(info(op).glsl.front())) != 0; }

  // A variable, a substituted parameter, or made of something that has a name here already: arguments come
  // first.
  bool inSpace(const Expr& e) const {
    if (e.op() == Op::Variable) return true;
    if (e.op() == Op::Parameter) return writer_.terms_.contains(e.parameterInfo().name);
    for (int i = 0; i < arity(e.op()); ++i)
      if (names_.contains(e.arg(i))) return true;
    return false;
  }

  // Is it one of those, or does it use one?
  bool isExact(const Expr& e) const {
    if (exactTerm(e.op()).empty()) return false;
    bool exact = writer_.exact_.contains(e);
    for (int i = 0; i < arity(e.op()); ++i) exact = exact || writer_.exact_.contains(e.arg(i).unclaimed());
    return exact;
  }

  std::string exactOperation(const Expr& e) {
    std::string term = exactTerm(e.op());
    for (std::size_t at; (at = term.rfind('$')) != std::string::npos;) {
      const Expr& argument = e.arg(term[at + 1] - '0').unclaimed();
      const auto exact = exactNames_.find(argument);
      term.replace(at, 2,
                   argument.isConstant()        ? exactLiteral(argument.constantValue())
                   : exact != exactNames_.end() ? exact->second
                                                : "double(" + name(argument) + ")");
    }
    return term;
  }

  std::string operation(const Expr& e) {
    std::string term(info(e.op()).glsl);
    for (std::size_t at; (at = term.rfind('$')) != std::string::npos;)
      term.replace(at, 2, name(e.arg(term[at + 1] - '0')));
    return term;
  }

  // The derivatives of a payload at a point are computed together.
  std::string payload(const Expr& e, const PayloadPart& part) {
    const std::string at = "(vec3(" + name(e.arg(0)) + ", " + name(e.arg(1)) + ", " + name(e.arg(2)) + "))";
    const std::string function = writer_.nameOf(part.payload);
    if (part.part == 0) return function + at;
    const auto [slopes, isNew] = slopes_.try_emplace(function + at, "s" + std::to_string(slopes_.size()));
    if (isNew) body_ += "  vec3 " + slopes->second + " = " + function + "Slopes" + at + ";\n";
    return slopes->second + "." + kComponents[part.part - 1];
  }

  GlslWriter& writer_;
  std::unordered_map<std::string, std::string> slopes_;  // by the call for the value
  std::unordered_map<Expr, std::string> names_;
  std::unordered_map<Expr, std::string> exactNames_;  // of doubles
  std::unordered_map<Expr, int> uses_;
  std::string body_;
  int lines_ = 0;
};

void GlslWriter::add(const std::string& name, std::span<const Expr> given) {
  const std::vector<Expr> outputs =
      numbers_ ? numbers_->take(given) : std::vector<Expr>(given.begin(), given.end());
  if (numbers_ && !numbers_->isSettled()) return;  // what is compared needs no text
  Body function(*this);
  function.write(outputs);
  const std::size_t count = outputs.size();
  const bool returns = count == 1 || count == 3;
  const std::string type = count == 1 ? "float" : "vec3";
  std::string list, stores;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string value = function.name(outputs[i]);
    list += (i == 0 ? "" : ", ") + value;
    stores += "  values[" + std::to_string(i) + "] = " + value + ";\n";
  }
  const std::string values = returns ? "" : ", out float values[" + std::to_string(count) + "]";
  functions_ += (returns ? type : "void") + " " + name + "(vec3 p, vec3 n" + values + ") {\n" +
                function.body() + (returns ? "  return " + type + "(" + list + ");\n" : stores) + "}\n\n";
}

void GlslWriter::label(const Expr& e, const std::string& comment) {
  std::string printable = comment;
  for (char& c : printable)
    if (c < ' ' || c > '~' || c == '\\') c = '?';
  for (const Expr& node : topologicalOrder({&e, 1})) labels_.try_emplace(node, comments_.size());
  comments_.push_back("  // " + printable);
  labelled_.insert(e);
}

std::string GlslWriter::commentOf(const Expr& e) const {
  const auto found = labels_.find(e);
  return found == labels_.end() ? "" : comments_[found->second];
}

std::string GlslWriter::changingTerm(double v) {
  if (!numbers_) return literal(v);
  uniforms_.emplace_back(v);
  return "u" + std::to_string(uniforms_.size() - 1);
}

std::string GlslWriter::uniform(const Expr& e) {
  const std::size_t slot = slots_.try_emplace(e, uniforms_.size()).first->second;
  if (slot == uniforms_.size()) uniforms_.push_back(numbers_ ? numbers_->now(e) : e);
  return "u" + std::to_string(slot);
}

std::string GlslWriter::nameOf(const std::shared_ptr<const Payload>& payload) {
  const auto place = std::find(payloads_.begin(), payloads_.end(), payload) - payloads_.begin();
  if (payloads_.begin() + place == payloads_.end()) payloads_.push_back(payload);
  return kPayload + std::to_string(place);
}

std::vector<std::pair<std::string, std::shared_ptr<const Payload>>> GlslWriter::payloads() const {
  std::vector<std::pair<std::string, std::shared_ptr<const Payload>>> all;
  for (const auto& payload : payloads_)
    all.emplace_back(kPayload + std::to_string(all.size()), numbers_ ? numbers_->now(payload) : payload);
  return all;
}

// Some drivers read a uniform anew in each turn of a loop, and check its index each time.
std::string GlslWriter::source() const {
  std::string text, takes;
  if (!uniforms_.empty())
    text += "uniform vec4 sdfValues[" + std::to_string((uniforms_.size() + 3) / 4) + "];\n";
  for (std::size_t i = 0; i < uniforms_.size(); ++i) {
    text += (i == 0 ? "float u" : ", u") + std::to_string(i);
    takes += "  u" + std::to_string(i) + " = sdfValues[" + std::to_string(i / 4) + "]." + kComponents[i % 4] +
             ";\n";
  }
  text += (uniforms_.empty() ? "" : ";\n") + ("void sdfTakeValues() {\n" + takes + "}\n\n");
  if (functions_.find("sdfSin(") != std::string::npos || functions_.find("sdfCos(") != std::string::npos)
    text += kExactSine;
  for (const auto& [name, code] : kHelpers)
    if (functions_.find(name + "(") != std::string::npos) text += code + "\n";
  for (const auto& [name, payload] : payloads()) text += payload->glsl(name) + "\n";
  return text + functions_;
}

}  // namespace sdf
