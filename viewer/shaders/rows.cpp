#include "viewer/shaders/rows.h"

#include <algorithm>

namespace sdf::viewer {
namespace {

constexpr std::size_t kNumbers = 4;  // of a texel
constexpr const char* kComponents = "xyzw";

std::size_t texelsOf(std::size_t numbers) { return (numbers + kNumbers - 1) / kNumbers; }

std::string variable(std::size_t place, std::size_t i) {
  return "row" + std::to_string(place) + "_" + std::to_string(i);
}

}  // namespace

void RowWriter::add(const NumberRows& rows) {
  const std::size_t stride = texelsOf(rows.parameters.size());
  tables_.push_back({{rows.numbers.size(), texels(), stride}, rows.parameters});
  for (const std::vector<Expr>& row : rows.numbers) {
    numbers_.insert(numbers_.end(), row.begin(), row.end());
    numbers_.resize(kNumbers * texelsOf(numbers_.size()), Expr(0.0));
  }
}

bool RowWriter::fits() const { return texels() <= std::size_t{kRowTexels} * kRowTexels; }

std::string RowWriter::takingFirst(std::size_t place, std::size_t count, const std::string& name) const {
  std::string text = "void sdfTake" + name + "(int at) {\n  vec4 v;\n";
  for (std::size_t i = 0; i < count; ++i) {
    if (i % kNumbers == 0) text += "  v = sdfTexel(at + " + std::to_string(i / kNumbers) + ");\n";
    text += "  " + variable(place, i) + " = v." + kComponents[i % kNumbers] + ";\n";
  }
  return text + "}\n";
}

std::string RowWriter::variables(std::size_t place, GlslWriter& writer) const {
  std::string text;
  const std::vector<Expr>& parameters = tables_[place].parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    text += (i == 0 ? "float " : ", ") + variable(place, i);
    writer.substitute(parameters[i].parameterInfo().name, variable(place, i));
  }
  return text + ";\n";
}

std::string RowWriter::taking(std::size_t places, GlslWriter& writer) const {
  std::string text =
      es_ ? "uniform sampler2D sdfRows;\nvec4 sdfTexel(int i) { return texelFetch(sdfRows, ivec2(i & " +
                std::to_string(kRowTexels - 1) + ", i >> " + std::to_string(kRowShift) + "), 0); }\n"
          : "uniform samplerBuffer sdfRows;\nvec4 sdfTexel(int i) { return texelFetch(sdfRows, i); }\n";
  for (std::size_t place = 0; place < places; ++place)
    text += variables(place, writer) +
            takingFirst(place, tables_[place].parameters.size(), std::to_string(place));
  return text;
}

std::string RowWriter::takingOne(std::size_t place, GlslWriter& writer) const {
  std::string text = "uniform vec4 sdfRow[" + std::to_string(tables_[place].range.stride) + "];\n" +
                     variables(place, writer) + "void sdfTake() {\n";
  for (std::size_t i = 0; i < tables_[place].parameters.size(); ++i)
    text += "  " + variable(place, i) + " = sdfRow[" + std::to_string(i / kNumbers) + "]." +
            kComponents[i % kNumbers] + ";\n";
  return text + "}\n";
}

}  // namespace sdf::viewer
