// Words and numbers of text files, whatever bytes these hold.
#pragma once
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

namespace sdf {

inline bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

/// The number that all of `word` spells: "1", "-.5e3", "nan", "inf". What is too large is infinite, what is
/// too small is 0.
template <std::floating_point T>
std::optional<T> numberOf(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const char* end = word.data() + word.size();
  T value = 0;
  const auto [stopped, error] = std::from_chars(word.data(), end, value);
  if (error == std::errc::invalid_argument || stopped != end) return std::nullopt;
  if (error == std::errc()) return value;
  const bool tiny = word.find("e-") != word.npos || word.find("E-") != word.npos;
  return tiny ? T(0) : std::copysign(std::numeric_limits<T>::infinity(), word[0] == '-' ? T(-1) : T(1));
}

template <std::integral T>
std::optional<T> wholeOf(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  T value = 0;
  const char* end = word.data() + word.size();
  const auto [stopped, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return value;
}

/// Takes text apart from its beginning on. It must outlive the scanner.
class TextScan {
 public:
  explicit TextScan(std::string_view text) : text_(text) {}

  bool atEnd() const { return at_ == text_.size(); }
  /// Of the line that is being read, from 1.
  std::size_t line() const { return line_; }
  std::size_t position() const { return at_; }

  /// The next word of this line; empty at its end.
  std::string_view word() {
    while (at_ < text_.size() && isBlank(text_[at_])) ++at_;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !isBlank(text_[at_]) && text_[at_] != '\n') ++at_;
    return text_.substr(begin, at_ - begin);
  }
  /// The next word of this or a later line; empty at the end of the text.
  std::string_view wordAnywhere() {
    std::string_view found = word();
    while (found.empty() && !atEnd()) {
      nextLine();
      found = word();
    }
    return found;
  }
  /// What is left of this line, without blanks around it. The next line comes next.
  std::string_view restOfLine() {
    std::string_view rest = text_.substr(at_, text_.find('\n', at_) - at_);
    nextLine();
    while (!rest.empty() && isBlank(rest.front())) rest.remove_prefix(1);
    while (!rest.empty() && isBlank(rest.back())) rest.remove_suffix(1);
    return rest;
  }
  void nextLine() {
    const std::size_t found = text_.find('\n', at_);
    at_ = found == text_.npos ? text_.size() : found + 1;
    line_ += found != text_.npos;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
};

}  // namespace sdf
