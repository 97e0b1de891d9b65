#include "results.h"

#include <cmath>
#include <cstring>
#include <sstream>

#include "command_line/text.h"

namespace sdf::chart {
namespace {

namespace fs = std::filesystem;

std::string quoted(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';  // a row is a line, so that half a row can be told
  if (text.find_first_of(",\"") == text.npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + '"';
}

std::string shown(double number) { return std::isnan(number) ? "" : command_line::formatted("%.9g", number); }

Error unwritable(const fs::path& file) {
  return {ErrorKind::Files, "cannot write '" + file.string() + "': " + std::strerror(errno)};
}

std::string contents(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace

std::string csvNames() {
  std::string line;
  for (const TextColumn& c : kKeyColumns) line += std::string(c.name) + ',';
  for (const NumberColumn& c : kNumberColumns) line += std::string(c.name) + ',';
  for (const TextColumn& c : kLastColumns) line += std::string(c.name) + ',';
  line.pop_back();
  return line;
}

std::string csvLine(const Row& row) {
  std::string line;
  for (const TextColumn& c : kKeyColumns) line += quoted(row.*c.cell) + ',';
  for (const NumberColumn& c : kNumberColumns) line += shown(row.*c.cell) + ',';
  for (const TextColumn& c : kLastColumns) line += quoted(row.*c.cell) + ',';
  line.pop_back();
  return line;
}

std::vector<std::string> csvCells(const std::string& line) {
  std::vector<std::string> cells(1);
  bool inQuotes = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && inQuotes && i + 1 < line.size() && line[i + 1] == '"')
      cells.back() += line[++i];
    else if (c == '"')
      inQuotes = !inQuotes;
    else if (c == ',' && !inQuotes)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

Result<Results> Results::open(const fs::path& file, const std::string& made) {
  Results results;
  results.file_ = file;
  const std::string begin = "# " + made + '\n' + csvNames() + '\n';
  std::string old = fs::exists(file) ? contents(file) : "";
  old.erase(old.rfind('\n') + 1);                      // all of it, where no line is whole
  if (old.find('\n') == old.rfind('\n')) old.clear();  // an interrupted run had measured nothing
  if (!old.empty() && !old.starts_with(begin)) {
    const std::string first = old.substr(0, old.find('\n'));
    if (!first.starts_with("# sdfchart "))
      return Error{ErrorKind::Files, "'" + file.string() +
                                         "' is not what sdfchart wrote; move it away, or take another folder "
                                         "with -o"};
    return Error{ErrorKind::Usage, "'" + file.string() + "' was measured by '" + first.substr(2) +
                                       "', which this run cannot go on with; remove it, or take another "
                                       "folder with -o"};
  }
  std::istringstream lines(old.substr(std::min(begin.size(), old.size())));
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> cells = csvCells(line);
    Row row;
    for (std::size_t i = 0; i < kKeyColumns.size() && i < cells.size(); ++i)
      row.*kKeyColumns[i].cell = cells[i];
    results.keys_.insert(row.key());
  }
  results.out_.open(file,
                    old.empty() ? std::ios::binary | std::ios::trunc : std::ios::binary | std::ios::app);
  if (!results.out_) return unwritable(file);
  if (old.empty()) {
    results.out_ << begin << std::flush;
    fs::remove(file.parent_path() / "pictures.csv");  // of rows that are not there any more
  } else {
    fs::resize_file(file, old.size());
  }
  if (!results.out_) return unwritable(file);
  return results;
}

Status Results::appendPictures(const Row& row) {
  const fs::path file = file_.parent_path() / "pictures.csv";
  std::string line;
  for (const TextColumn& c : kKeyColumns) line += quoted(row.*c.cell) + ',';
  line += std::to_string(row.pictureSide) + ',' + row.picture + ',' + row.truePicture + '\n';
  std::ofstream pictures(file, std::ios::binary | std::ios::app);
  pictures << line << std::flush;
  return pictures ? okStatus() : Status(unwritable(file));
}

Status Results::append(const Row& row) {
  keys_.insert(row.key());
  if (!row.picture.empty())
    if (Status s = appendPictures(row); !s) return s;
  out_ << csvLine(row) + '\n' << std::flush;
  return out_ ? okStatus() : Status(unwritable(file_));
}

}  // namespace sdf::chart
