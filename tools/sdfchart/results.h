// results.csv: a row for each measurement, written as soon as it is taken; pictures.csv beside it.
#pragma once
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "row.h"
#include "sdf/base/result.h"

namespace sdf::chart {

/// A row as a line of the file, without its end: cells between commas, in quotes where they hold a comma, a
/// quote or a line's end (RFC 4180).
std::string csvLine(const Row& row);
/// The line of the columns' names.
std::string csvNames();
/// The cells of a line.
std::vector<std::string> csvCells(const std::string& line);

/// The file that a run adds to. What an interrupted run has left of its last line is dropped.
class Results {
 public:
  /// Opens the file, or begins it with a comment that says how it was measured (`made`: version, options,
  /// seed) and the columns' names. Errors: Files (cannot be written, or is no such file), Usage (it was
  /// measured with other options).
  static Result<Results> open(const std::filesystem::path& file, const std::string& made);

  /// Is the measurement there already?
  bool has(const Row& row) const { return keys_.contains(row.key()); }
  std::size_t size() const { return keys_.size(); }
  /// Writes the row and hands it to the system; its pictures, if it has some, as a line of pictures.csv.
  /// Errors: Files.
  Status append(const Row& row);

 private:
  Status appendPictures(const Row& row);

  std::filesystem::path file_;
  std::set<std::string> keys_;
  std::ofstream out_;
};

}  // namespace sdf::chart
