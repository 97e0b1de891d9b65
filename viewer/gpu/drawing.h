// How fragments that fall on one pixel are put together, while one of these lives. What counts otherwise is
// the last.
#pragma once

namespace sdf::viewer {

/// Lets the fragment of the least depth win, in targets that have depth.
class NearestWins {
 public:
  NearestWins();
  ~NearestWins();
  NearestWins(const NearestWins&) = delete;
  NearestWins& operator=(const NearestWins&) = delete;
};

/// Adds up the values of all fragments.
class SumOfAll {
 public:
  SumOfAll();
  ~SumOfAll();
  SumOfAll(const SumOfAll&) = delete;
  SumOfAll& operator=(const SumOfAll&) = delete;
};

/// Lets fragments into one layer only; the others stay as they are.
class OneLayer {
 public:
  explicit OneLayer(int layer);
  ~OneLayer();
  OneLayer(const OneLayer&) = delete;
  OneLayer& operator=(const OneLayer&) = delete;
};

}  // namespace sdf::viewer
