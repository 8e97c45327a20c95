// Filter: called once per run with the complete cloud; checks the returned cloud, its attributes
// and its report.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include <dsc/config/yaml.hpp>
#include <dsc/text/words.hpp>

#include "plugin/checked.hpp"

namespace dsc::plugin {
namespace {

void check_size(const Call& current, std::string_view what, std::size_t size, std::size_t points) {
    if (size == 0 || size == points) return;
    fail(current, "strategy.size",
         fmt::format("gave {} {} for {}", size, what, text::counted(points, "point")),
         "an attribute is empty or has one entry per point; report this to the plugin's authors");
}

void check_finite(const Call& current, std::string_view what, const std::vector<Vec3>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i].allFinite()) continue;
        fail(current, "strategy.not_finite",
             "gave " + entry(what, i) + " a coordinate that is not finite", report_it);
    }
}

void check_normals(const Call& current, const std::vector<Vec3>& normals) {
    constexpr double tolerance = 1e-6;  // large enough for normals that were stored as floats
    for (std::size_t i = 0; i < normals.size(); ++i) {
        if (std::abs(normals[i].norm() - 1.0) <= tolerance || normals[i].isZero(0.0)) continue;
        fail(current, "strategy.range",
             "gave " + entry("normal", i) + " the length " + config::real_text(normals[i].norm()),
             "normals are unit vectors, or zero if they are unknown; report this to the plugin's "
             "authors");
    }
}

void check_confidence(const Call& current, const std::vector<double>& confidence) {
    for (std::size_t i = 0; i < confidence.size(); ++i) {
        if (confidence[i] >= 0.0 && confidence[i] <= 1.0) continue;  // false for NaN
        fail(current, "strategy.range",
             fmt::format("gave point {} the confidence {:f}", i, confidence[i]),
             "confidences lie in [0, 1]; report this to the plugin's authors");
    }
}

void check_orientation(const Call& current, const cloud::Orientation& orientation) {
    for (const double value : {orientation.residual, orientation.noise}) {
        if (std::isfinite(value) && value >= 0.0) continue;
        fail(current, "strategy.range",
             fmt::format("gave the orientation the residual {:f} and the noise {:f}",
                         orientation.residual, orientation.noise),
             "both are finite and at least 0; report this to the plugin's authors");
    }
    for (std::size_t i = 0; i < orientation.samples.size(); ++i) {
        const cloud::SurfaceSample& sample = orientation.samples[i];
        if (!sample.position.allFinite() || !sample.area.allFinite() ||
            !std::isfinite(sample.width)) {
            fail(current, "strategy.not_finite",
                 "gave " + entry("sample", i) + " of the orientation a value that is not finite",
                 report_it);
        }
        if (sample.width < 0.0) {
            fail(current, "strategy.range",
                 fmt::format("gave {} of the orientation the width {:f}", entry("sample", i),
                             sample.width),
                 "widths are at least 0; report this to the plugin's authors");
        }
    }
}

void check_cloud(const Call& current, const cloud::Cloud& cloud) {
    const std::size_t points = cloud.points.size();
    if (points == 0)
        fail(current, "strategy.size", "gave a cloud without points",
             "at least one point must be left; relax its parameters or leave it out");
    check_size(current, "colours", cloud.colours.size(), points);
    check_size(current, "normals", cloud.normals.size(), points);
    check_size(current, "areas", cloud.areas.size(), points);
    check_size(current, "confidences", cloud.confidence.size(), points);
    check_finite(current, "point", cloud.points);
    check_finite(current, "normal", cloud.normals);
    check_finite(current, "area", cloud.areas);
    check_normals(current, cloud.normals);
    check_confidence(current, cloud.confidence);
    check_orientation(current, cloud.orientation);
}

void check_report(const Call& current, const cloud::FilterReport& told, std::size_t given,
                  std::size_t left) {
    // Compared without the sum, which could overflow.
    if (told.kept != left || told.removed > given || given - told.removed != told.kept) {
        fail(current, "strategy.size",
             fmt::format(
                 "reported {} points as kept and {} as removed, but was given {} and returned {}",
                 told.kept, told.removed, given, left),
             "a filter adds no points, and kept and removed points together are the given points; "
             "report this to the plugin's authors");
    }
    std::size_t rest = told.removed;
    bool adds_up = true;
    for (const cloud::RemovedPoints& removed : told.reasons) {
        if (removed.reason.empty() || removed.reason.find('\n') != std::string::npos) {
            fail(current, "strategy.range", "gave a reason that is not one line of text",
                 report_it);
        }
        adds_up = adds_up && removed.count <= rest;
        rest -= std::min(rest, removed.count);
    }
    if (!told.reasons.empty() && (!adds_up || rest != 0)) {
        fail(current, "strategy.size",
             "gave reasons whose counts do not add up to the " +
                 text::counted(told.removed, "removed point"),
             report_it);
    }
    for (const std::string& note : told.notes) {
        if (note.empty() || note.find('\n') != std::string::npos)
            fail(current, "strategy.range", "gave a note that is not one line of text", report_it);
    }
    check_answer(current, told.figures);
}

bool same(const cloud::Orientation& a, const cloud::Orientation& b) {
    return a.samples.size() == b.samples.size() &&
           std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(),
                      [](const auto& x, const auto& y) {
                          return x.position == y.position && x.area == y.area && x.width == y.width;
                      });
}

class CheckedFilter final : public Checked<hooks::CloudFilter> {
public:
    using Checked::Checked;

    cloud::Filtered apply(const cloud::Cloud& cloud, const hooks::FilterContext& context) override {
        hooks::FilterContext own_context = context;
        own_context.instance = instance();
        const Call current = call("apply");
        cloud::Filtered result =
            guarded(current, [&] { return inner().apply(cloud, own_context); });
        check_cloud(current, result.cloud);
        check_report(current, result.report, cloud.points.size(), result.cloud.points.size());
        result.report.filter = current.who.id;
        result.cloud.source = cloud.source;  // the points still come from this source
        // An orientation that the filter only passed on is not valid for other points than those
        // from which it was estimated.
        cloud::Orientation& orientation = result.cloud.orientation;
        if (!orientation.empty() && result.cloud.points != cloud.points &&
            same(orientation, cloud.orientation))
            orientation = {};
        return result;
    }
};

}  // namespace

std::unique_ptr<hooks::Strategy> check_filter(std::unique_ptr<hooks::CloudFilter> inner,
                                              Attribution attribution) {
    return std::make_unique<CheckedFilter>(std::move(inner), std::move(attribution));
}

}  // namespace dsc::plugin
