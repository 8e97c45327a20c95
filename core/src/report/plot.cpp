// Plots as SVG.
#include "plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include <dsc/text/numbers.hpp>

#include "html.hpp"

namespace dsc::report {
namespace {

constexpr double width = 460, height = 250;
constexpr double left = 58, right = 14, top = 34, bottom = 40;

/// A coordinate on the page; a tenth of a unit is finer than print.
std::string at(double value) { return text::fixed(value, 1); }

std::string label(double x, double y, const std::string& text, const char* classes,
                  const char* anchor = "middle") {
    return "<text x=\"" + at(x) + "\" y=\"" + at(y) + "\" class=\"" + classes +
           "\" text-anchor=\"" + anchor + "\">" + html::text(text) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const char* classes) {
    return "<line x1=\"" + at(x1) + "\" y1=\"" + at(y1) + "\" x2=\"" + at(x2) + "\" y2=\"" +
           at(y2) + "\" class=\"" + classes + "\"/>\n";
}

std::string rectangle(double x, double y, double w, double h, const std::string& classes,
                      const std::string& title = "") {
    std::string out = "<rect x=\"" + at(x) + "\" y=\"" + at(y) + "\" width=\"" + at(w) +
                      "\" height=\"" + at(h) + "\" class=\"" + classes + "\"";
    return out + (title.empty() ? "/>\n" : "><title>" + html::text(title) + "</title></rect>\n");
}

std::string colour(std::size_t index) { return "c" + std::to_string(index % most_colours); }

std::string open_svg(const std::string& title, double w, double h) {
    return "<svg viewBox=\"0 0 " + at(w) + " " + at(h) + "\" role=\"img\" aria-label=\"" +
           html::text(title) + "\">\n";
}

/// An axis: maps numbers to positions on the page.
struct PlotAxis {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    double begin = 0, end = 1;  // on the page
    bool logarithmic = false;

    bool takes(double value) const { return std::isfinite(value) && (!logarithmic || value > 0.0); }
    void hold(double value) {
        if (!takes(value)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    bool empty() const { return low > high; }
    void settle() {
        if (logarithmic) {
            low = std::pow(10.0, std::floor(std::log10(low) * 2.0) / 2.0);
            high = std::pow(10.0, std::ceil(std::log10(high) * 2.0) / 2.0);
            if (low >= high) high = low * 10.0;
            return;
        }
        if (low == high) {
            const double margin = low == 0.0 ? 1.0 : 0.1 * std::abs(low);
            high += margin;
            if (low != 0.0) low -= margin;
        }
    }
    double place(double value) const {
        const double part = logarithmic ? std::log(value / low) / std::log(high / low)
                                        : (value - low) / (high - low);
        return begin + part * (end - begin);
    }
    std::vector<double> ticks(int count) const {
        if (!logarithmic) return axis_ticks(low, high, count);
        std::vector<double> out;
        const bool wide = std::log10(high / low) > 2.5;
        for (double decade = std::pow(10.0, std::floor(std::log10(low))); decade <= high;
             decade *= 10.0) {
            for (const double digit : {1.0, 3.0}) {
                if (digit > 1.0 && wide) continue;
                const double tick = digit * decade;
                if (tick >= low * (1.0 - 1e-9) && tick <= high * (1.0 + 1e-9)) out.push_back(tick);
            }
        }
        return out;
    }
};

std::string tick_text(double value) {
    if (value != 0.0 && std::abs(value) >= 10000.0 && value == std::floor(value) &&
        std::abs(value) < 1e9)
        return html::integer(value);
    return text::rounded(value);
}

std::string frame(const PlotAxis& x, const PlotAxis& y, const std::string& title,
                  const std::string& x_label) {
    std::string out = label(left, 16, title, "title", "start");
    for (const double tick : y.ticks(5)) {
        out += line(left, y.place(tick), width - right, y.place(tick), "grid");
        out += label(left - 6, y.place(tick) + 3.5, tick_text(tick), "tick", "end");
    }
    for (const double tick : x.ticks(7)) {
        out += line(x.place(tick), height - bottom, x.place(tick), height - bottom + 4, "axis");
        out += label(x.place(tick), height - bottom + 16, tick_text(tick), "tick");
    }
    out += line(left, height - bottom, width - right, height - bottom, "axis");
    return out + label(0.5 * (left + width - right), height - 6, x_label, "tick");
}

/// Thins a long curve to the resolution of the page: the first, least, greatest and last value of
/// each part keep its outline.
std::vector<std::size_t> outline(const Curve& curve, std::size_t most) {
    std::vector<std::size_t> kept;
    const std::size_t count = std::min(curve.x.size(), curve.y.size());
    if (count <= most) {
        for (std::size_t i = 0; i < count; ++i) kept.push_back(i);
        return kept;
    }
    const std::size_t stretch = count / (most / 4) + 1;
    for (std::size_t begin = 0; begin < count; begin += stretch) {
        const std::size_t end = std::min(begin + stretch, count);
        std::size_t least = begin, greatest = begin;
        for (std::size_t i = begin; i < end; ++i) {
            if (curve.y[i] < curve.y[least]) least = i;
            if (curve.y[i] > curve.y[greatest]) greatest = i;
        }
        std::array<std::size_t, 4> four = {begin, least, greatest, end - 1};
        std::sort(four.begin(), four.end());
        for (const std::size_t i : four) {
            if (kept.empty() || kept.back() != i) kept.push_back(i);
        }
    }
    return kept;
}

/// The classes of a curve or of its mark in the legend, and the number of its run.
std::string classes(const Curve& curve, const std::string& own, std::size_t index) {
    if (!curve.run) return "class=\"" + own + colour(index) + "\"";
    return "class=\"" + own + (curve.slot ? colour(*curve.slot) : "off") + "\" data-run=\"" +
           std::to_string(*curve.run) + "\"";
}

std::string path(const Curve& curve, const PlotAxis& x, const PlotAxis& y, std::size_t index,
                 std::size_t most) {
    std::string d;
    bool pen_down = false;
    for (const std::size_t i : outline(curve, most)) {
        const bool drawn = x.takes(curve.x[i]) && y.takes(curve.y[i]);
        if (drawn)
            d += (pen_down ? "L" : "M") + at(x.place(curve.x[i])) + " " + at(y.place(curve.y[i]));
        pen_down = drawn;
    }
    return "<path d=\"" + d + "\" " + classes(curve, "curve ", index) + "><title>" +
           html::text(curve.name) + "</title></path>\n";
}

std::string legend(const std::vector<Curve>& curves) {
    std::string items;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const Curve& curve = curves[i];
        items += std::string("<span") + (curve.run && !curve.slot ? " hidden" : "") + "><i " +
                 classes(curve, "", i) + "></i>" + html::text(curve.name) + "</span>";
    }
    return "<figcaption>" + items + "</figcaption>";
}

}  // namespace

std::vector<double> axis_ticks(double low, double high, int count) {
    std::vector<double> out;
    if (!(high > low) || count < 1) return out;
    const double rough = (high - low) / count,
                 power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10.0 * power;
    for (const double nice : {1.0, 2.0, 5.0}) {
        if (nice * power >= rough) {
            step = nice * power;
            break;
        }
    }
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
        out.push_back(k * step + 0.0);  // no -0
    return out;
}

std::string svg_plot(const Plot& plot) {
    PlotAxis x{.begin = left, .end = width - right};
    PlotAxis y{.begin = height - bottom, .end = top, .logarithmic = plot.logarithmic};
    bool enough = false;
    for (const Curve& curve : plot.curves) {
        std::size_t points = 0;
        for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
            if (!x.takes(curve.x[i]) || !y.takes(curve.y[i])) continue;
            x.hold(curve.x[i]);
            y.hold(curve.y[i]);
            ++points;
        }
        enough = enough || points > 1;
    }
    if (!enough) return "";
    if (plot.from_zero && !plot.logarithmic) y.hold(0.0);
    x.settle();
    y.settle();
    std::string out = open_svg(plot.title, width, height) + frame(x, y, plot.title, plot.x_label);
    for (std::size_t i = 0; i < plot.curves.size(); ++i)
        out += path(plot.curves[i], x, y, i, plot.points);
    return html::tag("figure",
                     out + "</svg>" + (plot.curves.size() > 1 ? legend(plot.curves) : "")) +
           "\n";
}

std::vector<std::size_t> count_bins(const std::vector<double>& values, double low, double high,
                                    std::size_t bins) {
    std::vector<std::size_t> counts(bins, 0);
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        const double part = std::clamp((value - low) / (high - low), 0.0, 1.0);
        ++counts[std::min(bins - 1, static_cast<std::size_t>(part * static_cast<double>(bins)))];
    }
    return counts;
}

std::string svg_histogram(const std::string& title, const std::string& x_label, double low,
                          double high, const std::vector<std::size_t>& counts) {
    PlotAxis x{.low = low, .high = high, .begin = left, .end = width - right};
    PlotAxis y{.low = 0, .high = 1, .begin = height - bottom, .end = top};
    for (const std::size_t count : counts) y.hold(static_cast<double>(count));
    std::string out = open_svg(title, width, height) + frame(x, y, title, x_label);
    const double step = (high - low) / static_cast<double>(counts.size());
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] == 0) continue;
        const double from = low + static_cast<double>(i) * step;
        const double place = y.place(static_cast<double>(counts[i]));
        out += rectangle(x.place(from) + 0.5, place, x.place(from + step) - x.place(from) - 1,
                         height - bottom - place, "bar",
                         html::real(from) + " to " + html::real(from + step) + ": " +
                             html::integer(static_cast<double>(counts[i])));
    }
    return html::tag("figure", out + "</svg>") + "\n";
}

std::string svg_shares(const std::vector<std::pair<std::string, double>>& parts,
                       const std::string& unit) {
    double sum = 0.0;
    for (const auto& [name, value] : parts)
        sum += std::isfinite(value) ? std::max(0.0, value) : 0.0;
    if (!(sum > 0.0)) return "";
    constexpr double length = 940, thickness = 26;
    std::string out = open_svg("parts of the whole", length, thickness), items;
    double from = 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto& [name, value] = parts[i];
        if (!std::isfinite(value) || value <= 0.0) continue;
        const std::string text = name + " " + html::real(value) + " " + unit;
        const double share = length * value / sum;
        out += rectangle(from, 0, share, thickness, "fill " + colour(i), text);
        items += "<span><i class=\"" + colour(i) + "\"></i>" + html::text(text) + "</span>";
        from += share;
    }
    return "<figure class=\"shares\">" + out + "</svg><figcaption>" + items +
           "</figcaption></figure>\n";
}

}  // namespace dsc::report
