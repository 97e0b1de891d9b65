#include "command_line/values.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace sdf::command_line {
namespace {

// A flag's number; `wanted` says which numbers are right, in words and as a test.
template <class Test>
Result<double> numberFor(const char* flag, const std::string& text, const std::string& wanted, Test right) {
  const std::optional<double> value = number(text);
  if (value && right(*value)) return *value;
  return usage(std::string(flag) + " needs " + wanted + ", got '" + text + "'");
}

// What CLI11 found wrong, in one line.
std::string described(const CLI::ParseError& error, const std::string& program) {
  std::string message = error.what();
  std::replace(message.begin(), message.end(), '\n', ' ');
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
    message = message.substr(0, message.find(':')) + " takes one value and can be given once";
  }
  return message + "; see " + program + " --help";
}

template <int most>
Result<double> countTo(const char* flag, const std::string& text) {
  return numberFor(flag, text, "a whole number from 1 to " + std::to_string(most),
                   [](double v) { return v >= 1.0 && v <= most && v == std::floor(v); });
}

}  // namespace

Error usage(std::string message) { return {ErrorKind::Usage, std::move(message)}; }

std::optional<double> number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::vector<double> numbers(const std::string& text) {
  std::vector<double> values;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const std::optional<double> value = number(word);
    if (!value) return {};
    values.push_back(*value);
  }
  if (!text.empty() && text.back() == ',') return {};
  return values;
}

Result<double> positive(const char* flag, const std::string& text) {
  return numberFor(flag, text, "a number above 0", [](double v) { return v > 0.0; });
}

Result<double> count(const char* flag, const std::string& text) { return countTo<100'000>(flag, text); }
Result<double> largeCount(const char* flag, const std::string& text) {
  return countTo<1'000'000'000>(flag, text);
}
Result<double> smallCount(const char* flag, const std::string& text) { return countTo<16>(flag, text); }

Result<double> seconds(const char* flag, const std::string& text) {
  return numberFor(flag, text, "a finite number of seconds", [](double) { return true; });
}

Result<std::map<std::string, double>> parameters(const std::vector<std::string>& words) {
  std::map<std::string, double> values;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const std::optional<double> value = number(equals == word.npos ? "" : word.substr(equals + 1));
    if (!value || name.empty()) return usage("-D needs name=value with a finite number, got '" + word + "'");
    if (!values.emplace(name, *value).second) return usage("-D sets '" + name + "' twice; keep one");
  }
  return values;
}

Result<std::optional<Answer>> parse(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return std::optional(Answer{app.help()});
  } catch (const CLI::CallForVersion&) {
    return std::optional(Answer{app.version() + "\n"});
  } catch (const CLI::ParseError& error) {
    return usage(described(error, app.get_name()));
  }
  return std::optional<Answer>();
}

}  // namespace sdf::command_line
