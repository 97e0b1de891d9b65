// Brings the reference part of a Markdown page up to date with the code: scene_reference
// docs/scene-language.md
#include <cstdio>
#include <fstream>
#include <sstream>

#include "sdf/script/reference.h"

int main(int count, char** arguments) {
  if (count != 2) return std::fputs("usage: scene_reference docs/scene-language.md\n", stderr), 2;
  std::ostringstream page;
  page << std::ifstream(arguments[1], std::ios::binary).rdbuf();
  const sdf::Result<std::string> updated = sdf::withSceneReference(page.str());
  if (!updated) return std::fprintf(stderr, "%s: %s\n", arguments[1], updated.error().message.c_str()), 5;
  std::ofstream out(arguments[1], std::ios::binary);
  out << *updated;
  if (!out.flush()) return std::fprintf(stderr, "%s: cannot be written\n", arguments[1]), 5;
}
