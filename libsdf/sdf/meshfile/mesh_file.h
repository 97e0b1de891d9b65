// The bytes of a mesh file and of what lies beside it, and how its errors read.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sdf/base/read_file.h"
#include "sdf/base/result.h"

namespace sdf {

struct MeshFile {
  std::filesystem::path path;
  std::string bytes;
};

/// The error for a file with more triangles than readMesh takes.
Error tooManyTriangles(const std::filesystem::path& file);

/// The words of a file, or of a library, as a message can show them: UTF-8, on one line, not long.
std::string onOneLine(std::string_view text);
/// The same in quotes.
std::string inQuotes(std::string_view text);

/// Adds a warning unless it is there already; of many, the last says that there are more.
void warn(std::vector<std::string>& warnings, const std::string& warning);

/// A whole file, which must be an ordinary one. Errors: Files, with the system's reason.
Result<MeshFile> readWhole(const std::filesystem::path& file);

/// A file that `from` names, by a path from its folder. The path must not be absolute, and must not lead out
/// of that folder, be it by symbolic links. Errors: Files.
Result<MeshFile> readBeside(const std::filesystem::path& from, const std::string& name);

}  // namespace sdf
