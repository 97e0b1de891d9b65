// What a driver says of a shader, beside the lines that it speaks of.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sdf::viewer {

/// A Complaint is one line of what a driver says.
struct Complaint {
  int line = 0;        ///< of the source, from 1; 0 if the driver names none
  std::string text;    ///< the driver's words, without the place
  std::string source;  ///< that line, without the blanks around it
};

/// Reads the log's lines, warnings left out. It knows the places of Mesa, "0:12(3): ", of NVIDIA, "0(12) : ",
/// and of ANGLE and Apple, "ERROR: 0:12: ". A source may not use #line.
std::vector<Complaint> readShaderLog(std::string_view log, std::string_view source);

/// Puts the first few complaints in one line.
std::string describe(const std::vector<Complaint>& complaints);

}  // namespace sdf::viewer
