#include "parts_progress.h"

#include <utility>

namespace sdf::exporter {

PartsProgress::Part::Part(PartsProgress& parts, std::size_t place)
    : Progress(&parts.line_), all(parts), number(place) {}

void PartsProgress::Part::beginStage(std::string_view name) {
  const std::lock_guard lock(all.mutex_);
  stage = name, share = 0.0;
  if (number == all.shown_) all.line_.beginStage(stage);
}

void PartsProgress::Part::update(double fraction) {
  const std::lock_guard lock(all.mutex_);
  share = fraction;
  if (number == all.shown_) all.line_.update(share);
}

PartsProgress::PartsProgress(command_line::ProgressLine& line, std::size_t parts,
                             std::function<std::string(std::size_t)> subject)
    : line_(line), subject_(std::move(subject)) {
  for (std::size_t i = 0; i < parts; ++i) parts_.emplace_back(*this, i);
  show();
}

void PartsProgress::end(std::size_t part) {
  const std::lock_guard lock(mutex_);
  parts_[part].ended = true;
  if (part != shown_) return;
  while (shown_ < parts_.size() && parts_[shown_].ended) ++shown_;
  show();
}

void PartsProgress::stopAfter(std::size_t part) {
  for (std::size_t i = part + 1; i < parts_.size(); ++i) parts_[i].stop();
}

void PartsProgress::show() {
  if (shown_ == parts_.size()) return;
  const Part& part = parts_[shown_];
  line_.setSubject(subject_(shown_));
  if (part.stage.empty()) return;
  line_.beginStage(part.stage);
  line_.update(part.share);
}

}  // namespace sdf::exporter
