// Known ways in which signed distance methods fail: each a scene, the naive method's figure, and ours.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace sdf::accuracy {

/// What both methods measured on one scene; 0 is perfect, larger is worse. NaN counts as infinitely bad.
struct Figures {
  double naive = 0.0;
  double ours = 0.0;
};

/// A method, in words: "minimum of the distances, dense samples"; and the limit of its figure.
struct Method {
  std::string what;
  double limit;
};

struct FailureCase {
  std::string name;              ///< the case in a few words: "two boxes share a face"
  std::string figure;            ///< what is measured, with its unit: "extra components"
  Method naive;                  ///< its figure reaches the limit, or the case would not be real
  Method ours;                   ///< what ours does instead; its figure must not exceed the limit
  std::string reason;            ///< where the two limits come from
  std::function<Figures()> run;  ///< deterministic, a few seconds at most

  /// The naive method fails as badly as said.
  bool isReal(const Figures& f) const { return !(f.naive < naive.limit); }
  /// Ours holds to what is said; NaN does not.
  bool isHeld(const Figures& f) const { return f.ours <= ours.limit; }
};

/// Cases of formulas, of warped and repeated space, of blends, of marching, of shading, and of meshing.
std::vector<FailureCase> formulaFailures();
std::vector<FailureCase> warpFailures();
std::vector<FailureCase> blendFailures();
std::vector<FailureCase> marchingFailures();
std::vector<FailureCase> shadingFailures();
std::vector<FailureCase> meshingFailures();

/// All of them.
inline std::vector<FailureCase> failureCases() {
  std::vector<FailureCase> all = formulaFailures();
  for (const auto& list :
       {warpFailures(), blendFailures(), marchingFailures(), shadingFailures(), meshingFailures()})
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace sdf::accuracy
