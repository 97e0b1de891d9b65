// How much memory a piece of work takes.
#pragma once

namespace sdf::chart {

/// Follows the process's memory from its making on (Linux: VmHWM is set back by clear_refs, proc(5)). What
/// earlier work has freed is given back to the system before, so that it hides nothing.
class MemoryPeak {
 public:
  MemoryPeak();
  /// Most bytes since then beyond those held then; not a number where the system does not tell.
  double bytes() const;
  /// bytes(), and forgets that there were so many: the next are the most from here on.
  double restart();

 private:
  double before_ = 0.0;
};

}  // namespace sdf::chart
