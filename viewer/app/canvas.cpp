#include "viewer/app/canvas.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "viewer/gpu/context.h"
#include "viewer/render/legend.h"

namespace sdf::viewer {
namespace {

constexpr int kRgba = 4, kRgb = 3;

/// A side.
int samplesAtRestOf(const Session& session) {
  return std::max(session.controls.samples, usefulSamples(session.renderer().shaders().plan));
}

int scaled(int pixels, double scale) { return std::max(1, static_cast<int>(std::lround(pixels * scale))); }

Picture withoutAlpha(const Picture& picture) {
  Picture result{picture.width, picture.height, kRgb, {}};
  for (std::size_t i = 0; i < picture.bytes.size(); ++i)
    if (i % kRgba != kRgb) result.bytes.push_back(picture.bytes[i]);
  return result;
}

}  // namespace

// Slower frames count at once, so that one slow frame is followed by a fast one; faster ones by half, so that
// the resolution does not jump about.
void Pace::drew(double seconds, double rays) {
  const double whole = seconds / rays;
  wholeFrame_ = whole > wholeFrame_ ? whole : 0.5 * (wholeFrame_ + whole);
}

double Pace::scale() const {
  if (wholeFrame_ <= kBudget) return 1.0;
  const double halvings = std::ceil(std::log2(wholeFrame_ / kBudget));  // of the pixels
  return std::max(std::exp2(-0.5 * halvings), kCoarsest);
}

void Pieces::drew(double rays, double seconds) {
  const double ray = seconds / rays;
  ray_ = ray_ && ray < *ray_ ? 0.5 * (*ray_ + ray) : ray;  // as Pace::drew
}

int Pieces::rows(int rays, int height, double seconds) const {
  constexpr int kFirst = 16;
  if (!ray_) return std::min(kFirst, height);
  const double least = std::ceil(double(height) / kMost);
  return static_cast<int>(std::clamp(seconds / (*ray_ * rays), least, double(height)));
}

double Canvas::secondsNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Result<bool> Canvas::update(Session& session, int width, int height, double now) {
  if (width < 1 || height < 1) return false;
  const Shown wanted{session.controls, session.compilations(), session.meshes(), width, height};
  const bool isAnother = !asked_ || asked_->compilations != wanted.compilations ||
                         asked_->meshes != wanted.meshes || asked_->width != width ||
                         asked_->height != height;
  if (asked_ != wanted) {
    lastChange_ = now;
    if (drawing_ && (isAnother || drawing_->scale == 1.0)) cancel();
  }
  asked_ = wanted;
  const bool isStill = now - lastChange_ >= kStill;
  if (!drawing_ && begun_ != asked_)
    begun_ ? begin(session, pace_.scale(), 1) : begin(session, 1.0, session.controls.samples);
  else if (!drawing_ && !whole_ && isStill)
    begin(session, 1.0, session.controls.samples);
  constexpr double kLeast = 0.25 * Pieces::kBudget;  // that a piece is worth beginning for
  const double start = clock_();
  const auto left = [&](double budget) { return budget - (clock_() - start); };
  if (drawing_) {
    do
      if (const Status drawn = draw(session, left(Pieces::kBudget)); !drawn) return drawn.error();
    while (drawing_ && left(Pieces::kBudget) > kLeast);
    if (drawing_ && !target_ && drawing_->scale == 1.0 && drawing_->seconds > kFirst) {
      cancel();
      begin(session, pace_.scale(), 1);
    }
    return !drawing_;
  }
  const int before = statistics_.refined;
  while (isStill && !resting() && left(kRefining) > 0.0)
    if (const Status refined = refine(session, Pieces::kBudget); !refined) return refined.error();
  return statistics_.refined > before;
}

void Canvas::begin(const Session& session, double scale, int samples) {
  begun_ = asked_;
  whole_ = false;
  row_ = 0;
  drawing_ = Drawing{session.frame(), scale, scaled(asked_->width, scale), scaled(asked_->height, scale)};
  drawing_->frame.samples = samples;
}

// What was drawn of it tells how fast one that moves can be.
void Canvas::cancel() {
  if (drawing_->share() > 0.0)
    pace_.drew(drawing_->seconds,
               drawing_->rays() * drawing_->share() / (double(begun_->width) * begun_->height));
  drawing_.reset();
}

std::optional<double> Canvas::drawnShare() const {
  return drawing_ ? std::optional(drawing_->share()) : std::nullopt;
}

// One sample after the other, as refine() does: each piece of a picture of many would have them all to begin.
Status Canvas::draw(Session& session, double seconds) {
  Drawing& d = *drawing_;
  if (const Status made = ensure(next_, d.width, d.height, {PixelFormat::Rgba8}); !made) return made;
  const Rows rows{d.row, std::min(pieces_.rows(d.width, d.height, seconds), d.height - d.row)};
  const double start = clock_();
  Renderer& renderer = session.renderer();
  const Status drawn = d.frame.samples == 1 ? renderer.draw(d.frame, *next_, rows)
                                            : renderer.refine(d.frame, d.sample, *next_, rows);
  if (!drawn) return drawn;
  viewer::finish();
  const double took = clock_() - start;
  pieces_.drew(double(d.width) * rows.count, took);
  d.seconds += took;
  d.row += rows.count;
  if (d.row < d.height) return okStatus();
  d.row = 0;
  return ++d.sample < d.frame.samples * d.frame.samples ? okStatus() : finish(session);
}

Status Canvas::finish(const Session& session) {
  const Drawing d = std::move(*drawing_);
  drawing_.reset();
  std::swap(target_, next_);
  const int atRest = samplesAtRestOf(session);
  samplesAtRest_ = atRest * atRest;
  statistics_ = {
      d.width, d.height, d.frame.samples, d.seconds, d.frame.samples == atRest ? samplesAtRest_ : 0, {}, {}};
  pace_.drew(d.seconds, d.rays() / (double(begun_->width) * begun_->height));
  whole_ = begun_ == asked_ && d.scale == 1.0 && d.frame.samples == session.controls.samples;
  if (!whole_) return okStatus();

  const auto picture = target_->picture();  // also where a lost context shows
  if (!picture) return picture.error();
  const double pixels = double(d.width) * d.height;
  statistics_.outOfSteps = static_cast<double>(pixelsOutOfSteps(*picture)) / pixels;
  statistics_.outOfShadowSteps = static_cast<double>(pixelsOutOfShadowSteps(*picture)) / pixels;
  return okStatus();
}

Status Canvas::refine(Session& session, double seconds) {
  const int width = target_->width(), height = target_->height();
  if (const Status made = ensure(next_, width, height, {PixelFormat::Rgba8}); !made) return made;
  Frame frame = session.frame();
  frame.samples = samplesAtRestOf(session);
  const Rows rows{row_, std::min(pieces_.rows(width, height, seconds), height - row_)};
  const double start = clock_();
  if (const Status drawn = session.renderer().refine(frame, statistics_.refined, *next_, rows); !drawn)
    return drawn;
  viewer::finish();
  pieces_.drew(double(width) * rows.count, clock_() - start);
  row_ += rows.count;
  if (row_ < height) return okStatus();
  row_ = 0;
  ++statistics_.refined;
  if (statistics_.refined > statistics_.samples * statistics_.samples) std::swap(target_, next_);
  return okStatus();
}

void Canvas::show() const {
  if (target_) target_->show(asked_->width, asked_->height);
}

Result<Picture> Canvas::picture(Session& session) {
  constexpr double kAllDay = 1e5;  // seconds
  if (!asked_) return Error{ErrorKind::Limits, "there is no picture yet"};
  if (!whole_) begin(session, 1.0, session.controls.samples);
  while (drawing_)
    if (const Status drawn = draw(session, kAllDay); !drawn) return drawn.error();
  while (!resting())
    if (const Status refined = refine(session, kAllDay); !refined) return refined.error();
  const auto picture = target_->picture();
  if (!picture) return picture.error();
  Picture shown = withoutAlpha(*picture);
  if (const ErrorFigures* errors = session.errors()) drawLegend(*errors, shown);
  return shown;
}

}  // namespace sdf::viewer
