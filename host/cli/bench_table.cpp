#include "cli/bench_table.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "cli/streams.h"

namespace vndf::cli {
namespace {

using bench::Result;

// One form of a function: its entries by mode.
struct Row {
    std::string function, rung;
    std::map<std::string, const Result*> modes;
};

std::vector<Row> rows_of(const std::vector<Result>& results) {
    std::vector<Row> rows;
    std::map<std::string, std::size_t> known;
    for (const Result& result : results) {
        const bench::EntryName name = bench::split(result.name);
        const auto [at, is_new] = known.try_emplace(name.function + '/' + name.form, rows.size());
        if (is_new) rows.push_back({name.function, name.form, {}});
        rows[at->second].modes[name.mode] = &result;
    }
    std::stable_sort(rows.begin(), rows.end(), [&](const Row& a, const Row& b) {
        return (a.rung.empty() ? "" : a.function) < (b.rung.empty() ? "" : b.function);
    });
    return rows;
}

const double* figure(const Row& row, const std::string& name) {
    for (const auto& [_, result] : row.modes) {
        const auto found = result->counters.find(name);
        if (found != result->counters.end()) return &found->second;
    }
    return nullptr;
}

// In at most five characters.
std::string number(double x) {
    if (x >= 9999.5) return fmt::format("{:.0e}", x);
    return fmt::format("{:.{}f}", x, x >= 99.95 ? 0 : x >= 9.995 ? 1 : 2);
}

std::string cell(const Row& row, const std::string& name) {
    const double* x = figure(row, name);
    return x ? number(*x) : std::string();
}

// An error: of a direction its angle.
std::string error(const Row& row, const std::string& which) {
    return figure(row, "angle_max") ? cell(row, "angle_" + which) : cell(row, "err_" + which);
}

// Of a sample; a GPU takes some hundredths.
std::string nanoseconds(double ns) {
    return ns < 0.1 ? fmt::format("{:.4f}", ns) : fmt::format("{:.2f}", ns);
}

std::string time(const Row& row, const std::string& mode) {
    const auto found = row.modes.find(mode);
    return found == row.modes.end() ? std::string() : nanoseconds(found->second->best_ns);
}

// A ratio of times: "=" if it is within what two identical kernels differ by.
std::string ratio(double x, const std::map<std::string, double>& spread, const std::string& mode) {
    const auto noise = spread.find(mode);
    if (noise != spread.end() && std::max(x, 1 / x) <= 1 + noise->second) return "=";
    return fmt::format("{:.2f}", x);
}

std::string price(const Row& row, const std::map<std::string, double>& spread) {
    for (const char* mode : {"cached", "compute", "stream"}) {
        const auto found = row.modes.find(mode);
        if (found == row.modes.end() || !found->second->counters.contains("price")) continue;
        return row.rung == "lean/float" ? "1" : ratio(found->second->counters.at("price"), spread, mode);
    }
    return {};
}

// Results that are none: not finite, or normals below the horizon.
std::string bad(const Row& row) {
    double count = 0;
    for (const char* name : {"nonfinite", "below"})
        if (const double* x = figure(row, name)) count += *x;
    return count == 0 ? "" : count < 9999.5 ? fmt::format("{:.0f}", count) : "many";
}

void print_rows(const std::vector<Row>& rows, const std::map<std::string, double>& spread) {
    const auto line = [](const auto&... cells) {
        put("{:23} {:>6} {:>6} {:>6} {:>6} {:>5} {:>5} {:>5} {:>6} {:>5} {:>5} {:>5} {:>4}\n", cells...);
    };
    line("ns a sample, best", "stream", "cached", "front", "1 lobe", "price", "p50", "p99", "p99.99", "max",
         "b p99", "b max", "bad");
    std::string function;
    for (const Row& row : rows) {
        if (row.rung.empty()) {
            if (row.modes.contains("stream")) put("{:23} {:>6}\n", row.function, time(row, "stream"));
            continue;
        }
        if (row.function != function) put("{}\n", function = row.function);
        line("  " + row.rung, time(row, "stream"), time(row, "cached"), time(row, "cached_front"),
             time(row, "compute"), price(row, spread), error(row, "p50"), error(row, "p99"),
             error(row, "p9999"), error(row, "max"), error(row, "back_p99"), error(row, "back_max"),
             bad(row));
    }
    put("\nstream: arrays in memory. cached: arrays in a cache, own lobe a sample, half of them back-facing\n"
        "where valid; front: none. 1 lobe: the same lobe for all. price: time over the lean form's, cached;\n"
        "=: within noise. Errors in eps, 2^-24 or 2^-53: the angle to the same map in exact arithmetic, of\n"
        "values the relative error in the unit of clvndf check; b: wo below the surface.\n"
        "bad: results that are not finite, and normals below the horizon.\n");
}

const Row* find(const std::vector<Row>& rows, const std::string& function, const std::string& rung) {
    for (const Row& row : rows)
        if (row.function == function && row.rung == rung) return &row;
    return nullptr;
}

// The sampler of visible normals that is fastest in strict float.
const Row* fastest(const std::vector<Row>& rows) {
    const Row* best = nullptr;
    for (const Row& row : rows) {
        const Function* f = find_function(row.function);
        if (row.rung != "strict/float" || !f || !is_plain_sampler(*f) || f->result != "WM" ||
            f->method != Method::exact || !f->arguments.starts_with("WO_") || !row.modes.contains("cached"))
            continue;
        if (!best || row.modes.at("cached")->best_ns < best->modes.at("cached")->best_ns) best = &row;
    }
    return best;
}

void print_sentences(const std::vector<Row>& rows, const std::map<std::string, double>& spread) {
    put("\n");
    if (const Row* best = fastest(rows)) {
        put("Fastest exact sampler of visible normals measured: {},\n{} ns a sample in cache", best->function,
            time(*best, "cached"));
        if (best->modes.contains("stream")) put(", {} from memory", time(*best, "stream"));
        if (const double* part = figure(*best, "fraction_of_copy"))
            put(" ({:.2f} of a plain copy's speed)", *part);
        put(".\n");
        if (const Row* lean = find(rows, best->function, "lean/float")) {
            const std::string paid = price(*best, spread);
            put("Its accuracy costs {}\nand buys a largest error of {} eps in place of {}",
                paid == "=" ? "nothing beyond noise" : fmt::format("{} times the lean form's time", paid),
                error(*best, "max"), error(*lean, "max"));
            if (figure(*best, "err_back_max"))
                put(", behind the surface {} in place of {}", error(*best, "back_max"),
                    error(*lean, "back_max"));
            put(";\nthe median is {} in place of {}.\n", error(*best, "p50"), error(*lean, "p50"));
        }
    }
    if (spread.empty()) {
        put("No kernel was measured twice: ratios within some 10 % of 1 mean nothing.\n");
        return;
    }
    double largest = 0;
    for (const auto& [_, x] : spread) largest = std::max(largest, x);
    put("Two identical kernels differ by up to {:.1f} % in this run: no ratio within that is a difference.\n",
        100 * largest);
}

}  // namespace

void print_measurement(const bench::Measurement& measurement) {
    const std::vector<Row> rows = rows_of(measurement.results);
    print_rows(rows, measurement.spread);
    print_sentences(rows, measurement.spread);
}

void print_beside(const bench::Measurement& measurement, const std::string& function) {
    const auto in_cache = [](const Row& row) -> const Result* {
        for (const char* mode : {"cached_front", "cached"})
            if (const auto found = row.modes.find(mode); found != row.modes.end()) return found->second;
        return nullptr;
    };
    const std::vector<Row> rows = rows_of(measurement.results);
    const Row *own = nullptr, *best = nullptr;
    for (const Row& row : rows) {
        if (!in_cache(row)) continue;
        if (row.function == function)
            own = &row;
        else if (row.rung == "strict/float" && (!best || in_cache(row)->best_ns < in_cache(*best)->best_ns))
            best = &row;
    }
    if (!own || !best) return;
    const double mine = in_cache(*own)->best_ns, fastest = in_cache(*best)->best_ns;
    put("\n{} takes {:.2f} ns a sample in cache, {:.2f} times what {} {} takes ({:.2f}).\n", function, mine,
        mine / fastest, best->function, best->rung, fastest);
}

void print_comparison(const std::vector<Result>& results, const std::vector<Result>& baseline,
                      const std::map<std::string, double>& spread, const std::string& baseline_name) {
    std::map<std::string, double> before;
    for (const Result& r : baseline) before[r.name] = r.best_ns;
    put("\nover {} (another run: its machine may have been busier)\n", baseline_name);
    for (const Result& r : results)
        if (before.contains(r.name))
            put("  {:78} {:>8}\n", r.name,
                ratio(r.best_ns / before[r.name], spread, bench::split(r.name).mode));
}

void print_advice(const std::vector<bench::Advice>& all, const bench::Demand& demand,
                  const std::map<std::string, double>& spread) {
    for (const bench::Advice& advice : all) {
        put("{}\n", advice.what);
        for (const bench::Candidate& c : advice.candidates)
            put("  {:58} {:>7} ns {:>9} eps{}\n", c.function->name + " " + c.rung, nanoseconds(c.ns),
                number(c.error),
                !c.sound                 ? "  not finite or below"
                : c.error > demand.error ? "  too much"
                : advice.best && advice.best->function == c.function && advice.best->rung == c.rung
                    ? "  <- this one"
                    : "");
    }
    put("\n");
    const auto noise = spread.find("cached");
    for (const bench::Advice& advice : all) {
        if (advice.best)
            put("{}: {} {}, {} ns, at most {} eps.\n", advice.what, advice.best->function->name,
                advice.best->rung, nanoseconds(advice.best->ns), number(advice.best->error));
        else
            put("{}: none of those measured has an error within {} eps.\n", advice.what,
                number(demand.error));
    }
    if (noise != spread.end())
        put("Times closer than {:.1f} % are the same: two identical kernels differ by that.\n",
            100 * noise->second);
}

}  // namespace vndf::cli
