#include "sdf/outline/path_data.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "sdf/outline/ellipse_arc.h"

namespace sdf {
namespace {

constexpr std::string_view kCommands = "MmLlHhVvCcSsQqTtAaZz";

bool isSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Reads numbers and letters one after the other.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  bool atEnd() {
    skipSpace();
    return at_ == text_.size();
  }
  /// The letter of a command, if one comes next.
  std::optional<char> command() {
    if (atEnd() || kCommands.find(text_[at_]) == std::string_view::npos) return {};
    return text_[at_++];
  }
  bool number(double& out) {
    skipSeparator();
    const std::size_t sign = at_ < text_.size() && (text_[at_] == '+' || text_[at_] == '-') ? 1 : 0;
    const std::size_t digits = at_ + sign;
    if (digits == text_.size() || !(isDigit(text_[digits]) || text_[digits] == '.')) return false;
    const char* begin = text_.data() + digits;
    const auto [end, failed] = std::from_chars(begin, text_.data() + text_.size(), out);
    if (failed != std::errc() || !std::isfinite(out)) return false;
    if (sign == 1 && text_[at_] == '-') out = -out;
    at_ = static_cast<std::size_t>(end - text_.data());
    return true;
  }
  /// A single 0 or 1, which nothing need part from what follows.
  bool flag(bool& out) {
    skipSeparator();
    if (at_ == text_.size() || (text_[at_] != '0' && text_[at_] != '1')) return false;
    out = text_[at_++] == '1';
    return true;
  }
  /// "at character 7, 'x'": what comes next.
  std::string here() {
    skipSpace();
    if (at_ == text_.size()) return "at its end";
    return "at its character " + std::to_string(at_ + 1) + ", '" + std::string(text_.substr(at_, 12)) + "'";
  }

 private:
  void skipSpace() {
    while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
  }
  void skipSeparator() {
    skipSpace();
    if (at_ < text_.size() && text_[at_] == ',') ++at_, skipSpace();
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

class PathReader {
 public:
  explicit PathReader(std::string_view data) : in_(data) {}

  Result<std::vector<Contour>> read() {
    while (!in_.atEnd()) {
      const auto command = in_.command();
      if (!command) return wrong("a command, one of M L H V C S Q T A Z,");
      if (contours_.empty() && lower(*command) != 'm')
        return Error{ErrorKind::Scene, "the path must begin with M, the place where it starts"};
      if (const Status done = repeated(*command); !done) return done.error();
    }
    std::erase_if(contours_, [](const Contour& c) { return c.curves.empty(); });
    return std::move(contours_);
  }

 private:
  Error wrong(const std::string& what) {
    return {ErrorKind::Scene, "the path has something else than " + what + " " + in_.here()};
  }

  // A command, and its repetitions without a letter.
  Status repeated(char command) {
    isRelative_ = command >= 'a';
    if (lower(command) == 'z') {
      at_ = contours_.back().from, isClosed_ = contours_.back().isClosed = true;
      before_ = command;
      return okStatus();
    }
    for (bool isFirst = true; isFirst || !isAtCommand(); isFirst = false) {
      if (!isFirst && !isAtNumber()) return wrong("a command or a number");
      // Further places of M are lines.
      if (!one(lower(command) == 'm' && !isFirst ? 'l' : lower(command))) return wrong(wanted_);
      if (++count_ > kMostCurves)
        return Error{ErrorKind::Scene,
                     "the path has more than " + std::to_string(kMostCurves) + " curves; simplify it"};
    }
    return okStatus();
  }
  bool isAtCommand() {
    if (in_.atEnd()) return true;
    Scanner ahead = in_;
    return ahead.command().has_value();
  }
  bool isAtNumber() const {
    Scanner ahead = in_;
    double number;
    return ahead.number(number);
  }

  bool one(char command) {
    wanted_ = "a number";
    const char before = std::exchange(before_, command);
    glm::dvec2 p[3];
    switch (command) {
      case 'm':
        if (!place(p[0])) return false;
        contours_.push_back({at_ = p[0], {}}), isClosed_ = false;
        return true;
      case 'l':
        return place(p[0]) && add({0, {}, p[0]});
      case 'h':
        return along(p[0].x, at_.x) && add({0, {}, {p[0].x, at_.y}});
      case 'v':
        return along(p[0].y, at_.y) && add({0, {}, {at_.x, p[0].y}});
      case 'q':
        return place(p[0]) && place(p[1]) && add({1, {p[0]}, p[1]});
      case 't':
        return place(p[0]) && add({1, {before == 'q' || before == 't' ? mirrored() : at_}, p[0]});
      case 'c':
        return place(p[0]) && place(p[1]) && place(p[2]) && add({2, {p[0], p[1]}, p[2]});
      case 's':
        return place(p[0]) && place(p[1]) &&
               add({2, {before == 'c' || before == 's' ? mirrored() : at_, p[0]}, p[1]});
      default:
        return arc();
    }
  }

  bool arc() {
    EllipseArc arc;
    if (!in_.number(arc.radii.x) || !in_.number(arc.radii.y) || !in_.number(arc.turn)) return false;
    wanted_ = "a flag, 0 or 1,";
    if (!in_.flag(arc.isLarge) || !in_.flag(arc.isPositive)) return false;
    wanted_ = "a number";
    if (!place(arc.to)) return false;
    for (const Curve& c : curvesOf(at_, arc)) add(c);
    return true;
  }

  bool along(double& out, double from) {
    if (!in_.number(out)) return false;
    if (isRelative_) out += from;
    return true;
  }
  bool place(glm::dvec2& out) { return along(out.x, at_.x) && along(out.y, at_.y); }
  // The last control point, seen from the other side.
  glm::dvec2 mirrored() const { return 2.0 * at_ - last_; }

  bool add(const Curve& curve) {
    if (std::exchange(isClosed_, false)) contours_.push_back({at_, {}});
    contours_.back().curves.push_back(curve);
    if (curve.controls > 0) last_ = curve.control[curve.controls - 1];
    at_ = curve.to;
    return true;
  }

  Scanner in_;
  std::vector<Contour> contours_;
  glm::dvec2 at_{}, last_{};  // the pen; the last control point
  bool isRelative_ = false, isClosed_ = false;
  char before_ = 0;          // the last command, small
  const char* wanted_ = "";  // what should come next
  std::size_t count_ = 0;
};

}  // namespace

Result<std::vector<Contour>> pathContours(std::string_view data) { return PathReader(data).read(); }

}  // namespace sdf
