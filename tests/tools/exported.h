// What the tests of exports that work share.
#pragma once
#include <nlohmann/json.hpp>

#include "sdf2gltf.h"

namespace sdf {

using Json = nlohmann::json;

class Export : public Sdf2gltf {
 protected:
  void expectSuccess(const Outcome& outcome) {
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
  }

  Json report(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--report", out("report.json")});
    expectSuccess(run(arguments));
    return Json::parse(contents(out("report.json")));
  }

  /// The JSON chunk of a .glb, after its header of 12 bytes and the chunk's own of 8.
  static Json glbJson(const std::string& file) {
    const std::string bytes = contents(file);
    std::uint32_t length = 0;
    bytes.copy(reinterpret_cast<char*>(&length), 4, 12);
    return Json::parse(bytes.substr(20, length));
  }
};

}  // namespace sdf
