// The values of options, with messages that name the flag, what it needs and what it got. All errors are
// Usage.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sdf/base/result.h"

namespace CLI {
class App;
}

namespace sdf::command_line {

/// The command line was a question (--help, --version), and this is the answer.
struct Answer {
  std::string text;
};

Error usage(std::string message);

/// The whole text as a finite number.
std::optional<double> number(std::string_view text);
/// All of the text as finite numbers with commas between them; empty where it is something else.
std::vector<double> numbers(const std::string& text);

/// A flag's number above 0.
Result<double> positive(const char* flag, const std::string& text);
/// A whole number from 1 to 100000.
Result<double> count(const char* flag, const std::string& text);
/// A whole number from 1 to 1000000000.
Result<double> largeCount(const char* flag, const std::string& text);
/// A whole number from 1 to 16.
Result<double> smallCount(const char* flag, const std::string& text);
/// Any finite number of seconds.
Result<double> seconds(const char* flag, const std::string& text);

/// Words of the form name=value, each name once.
Result<std::map<std::string, double>> parameters(const std::vector<std::string>& words);

/// Fills `value` with one of these numbers, times `factor`, unless the flag was left out.
template <class T, class Target>
Status take(const char* flag, const std::optional<std::string>& text, Target& value,
            Result<double> (*parse)(const char* flag, const std::string& text), double factor = 1.0) {
  if (!text) return okStatus();
  Result<double> parsed = parse(flag, *text);
  if (!parsed) return parsed.error();
  value = static_cast<T>(*parsed * factor);
  return okStatus();
}

/// Reads the words into what the app declares; or the answer, if they were a question. Errors: what CLI11
/// finds wrong, in one line that names the app's --help.
Result<std::optional<Answer>> parse(CLI::App& app, int argc, const char* const* argv);

}  // namespace sdf::command_line
