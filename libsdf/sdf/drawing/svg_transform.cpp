#include "sdf/drawing/svg_transform.h"

#include <charconv>
#include <cmath>
#include <numbers>

namespace sdf {
namespace {

constexpr std::string_view kSeparators = " \t\r\n,";

void skip(std::string_view& text, std::string_view letters) {
  text.remove_prefix(std::min(text.find_first_not_of(letters), text.size()));
}

Affine shifted(double x, double y) { return {glm::dmat2(1.0), {x, y}}; }

// One of the list, with its numbers.
std::optional<Affine> transformOf(std::string_view name, const std::vector<double>& n) {
  const std::size_t count = n.size();
  const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180.0; };
  if (name == "matrix" && count == 6) return Affine{{n[0], n[1], n[2], n[3]}, {n[4], n[5]}};
  if (name == "translate" && (count == 1 || count == 2)) return shifted(n[0], count == 2 ? n[1] : 0.0);
  if (name == "scale" && (count == 1 || count == 2))
    return Affine{{n[0], 0.0, 0.0, count == 2 ? n[1] : n[0]}, {}};
  if (name == "rotate" && (count == 1 || count == 3)) {
    const double c = std::cos(radians(n[0])), s = std::sin(radians(n[0]));
    const Affine turn{{c, s, -s, c}, {}};
    return count == 1 ? turn : shifted(n[1], n[2]) * turn * shifted(-n[1], -n[2]);
  }
  if (name == "skewX" && count == 1) return Affine{{1.0, 0.0, std::tan(radians(n[0])), 1.0}, {}};
  if (name == "skewY" && count == 1) return Affine{{1.0, std::tan(radians(n[0])), 0.0, 1.0}, {}};
  return {};
}

}  // namespace

std::optional<std::vector<double>> numbersIn(std::string_view text) {
  std::vector<double> numbers;
  for (skip(text, kSeparators); !text.empty(); skip(text, kSeparators)) {
    if (text.front() == '+') text.remove_prefix(1);
    double number;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failed != std::errc() || !std::isfinite(number)) return {};
    numbers.push_back(number);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  return numbers;
}

std::optional<Affine> transformOf(std::string_view text) {
  Affine all;
  for (skip(text, kSeparators); !text.empty(); skip(text, kSeparators)) {
    const std::size_t open = text.find('('), close = text.find(')');
    if (open > close || close == std::string_view::npos) return {};
    const auto numbers = numbersIn(text.substr(open + 1, close - open - 1));
    std::string_view name = text.substr(0, open);
    name = name.substr(0, name.find_last_not_of(kSeparators) + 1);
    const auto one = numbers ? transformOf(name, *numbers) : std::nullopt;
    if (!one) return {};
    all = all * *one;
    text.remove_prefix(close + 1);
  }
  return all;
}

}  // namespace sdf
