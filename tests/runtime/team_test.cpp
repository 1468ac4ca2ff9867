// A team does each task once, hands results back in order, and goes on without a member that fails. No device is used.
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include "error.h"
#include "runtime/team.h"
#include "support/catch.h"

namespace {

using namespace vndf;
using namespace vndf::runtime;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::Equals;

std::vector<Device> alike(std::size_t count) {
    Device device;
    device.platform = "Acme", device.name = "one";
    return std::vector<Device>(count, device);
}

// What a run took, in the order in which it did.
struct Taken {
    std::vector<std::size_t> tasks;
    std::vector<std::string> results;

    Team::Plan plan(std::size_t count) {
        Team::Plan plan;
        plan.tasks = count;
        plan.take = [this](std::size_t task, const std::string& result) {
            tasks.push_back(task), results.push_back(result);
        };
        return plan;
    }
};

std::vector<std::string> squares(std::size_t count) {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < count; ++i) all.push_back(std::to_string(i * i));
    return all;
}

std::string square(const std::string& task) {
    return std::to_string(std::stoull(task) * std::stoull(task));
}

// Each member slower than the one before, and each fifth task slow.
Team::Hire uneven() {
    const auto hired = std::make_shared<std::atomic<int>>(0);
    return [hired](const Device&) -> Team::Work {
        const std::chrono::microseconds pause(300 * (*hired)++);
        return [pause](const std::string& task) {
            std::this_thread::sleep_for(pause +
                                        std::chrono::milliseconds(std::stoull(task) % 5 == 0 ? 3 : 0));
            return square(task);
        };
    };
}

// Members that do a few tasks and then fail, all but one.
Team::Hire short_lived(const Error& failure) {
    const auto hired = std::make_shared<std::atomic<int>>(0);
    return [hired, failure](const Device&) -> Team::Work {
        const int number = (*hired)++;
        return [=, done = 0](const std::string& task) mutable {
            if (number > 0 && ++done > 2) throw failure;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            return square(task);
        };
    };
}

}  // namespace

TEST_CASE(
    "a team's results come back in the order of the tasks, whoever does them and however long it takes") {
    Ranks ranks;
    for (const std::size_t members : {1, 2, 5}) {
        Team team(ranks, alike(members), uneven(), {});
        for (const std::size_t count : {0, 1, 3, 60}) {
            CAPTURE(members, count);
            Taken taken;
            CHECK(team.run(taken.plan(count)) == count);
            CHECK(taken.results == squares(count));
        }
    }
}

TEST_CASE("a task that depends on one before it is not begun before that one is taken") {
    Ranks ranks;
    Team team(ranks, alike(4), uneven(), {});
    Taken taken;
    Team::Plan plan = taken.plan(50);
    std::size_t furthest = 0;
    plan.window = 6;
    plan.task = [&](std::size_t task) -> std::optional<std::string> {
        furthest = std::max(furthest, task - taken.tasks.size());
        return task < 40 ? std::optional(std::to_string(task)) : std::nullopt;
    };
    CHECK(team.run(plan) == 40);
    CHECK(taken.results == squares(40));
    CHECK(furthest < 6);
    CHECK(furthest > 2);
}

TEST_CASE("a run that is stopped has taken the first tasks, without a gap") {
    Ranks ranks;
    Team team(ranks, alike(3), uneven(), {});
    Taken taken;
    Team::Plan plan = taken.plan(1000);
    plan.proceed = [](std::size_t done) { return done < 20; };
    const std::size_t count = team.run(plan);
    CHECK(count >= 20);
    CHECK(count < 40);
    CHECK(taken.results == squares(count));
}

TEST_CASE("the tasks of members that fail are done by others, and each failure is told") {
    Ranks ranks;
    std::vector<std::string> lost;
    Team::Options options;
    options.lost = [&](const std::string& what) { lost.push_back(what); };
    Team team(ranks, alike(4), short_lived(DeviceError("smoke")), options);
    Taken taken;
    CHECK(team.run(taken.plan(60)) == 60);
    CHECK(taken.results == squares(60));
    REQUIRE(lost.size() == 3);
    CHECK_THAT(lost.front(), ContainsSubstring("smoke") && ContainsSubstring("its work goes to the 3 left"));
}

TEST_CASE("when nobody is left, or the fault is the user's, the run ends with the error") {
    Ranks ranks;
    const Team::Hire nobody = [](const Device&) -> Team::Work { throw DeviceError("no build"); };
    Taken taken;
    {
        Team team(ranks, alike(3), nobody, {});
        CHECK_THROWS_AS(team.run(taken.plan(5)), DeviceError);
    }
    CHECK(taken.results.empty());
    Team team(ranks, alike(3), short_lived(InputError("no fp64")), {});
    CHECK_THROWS_AS(team.run(taken.plan(60)), InputError);
}

TEST_CASE("devices of different kinds are refused where results would depend on who does what") {
    Ranks ranks;
    std::vector<Device> devices = alike(2);
    devices[1].driver = "2.0";
    Team::Options options;
    CHECK_THROWS_WITH(Team(ranks, devices, uneven(), options),
                      ContainsSubstring("device 2 is 'Acme / one, , driver 2.0'"));
    options.alike = false;
    CHECK(Team(ranks, devices, uneven(), options).size() == 2);
}

// Alone, or as mpirun -n N clvndf_tests "[.team-speed]": for the model in README.md.
TEST_CASE("what a team costs beside its work", "[.team-speed]") {
    Ranks ranks;
    const Team::Hire idle = [](const Device&) -> Team::Work {
        return [](const std::string& task) { return task; };
    };
    {
        Team team(ranks, alike(1), idle, {});
        if (!ranks.leads()) team.serve();
        for (const std::size_t bytes : {std::size_t{100}, std::size_t{3000}, std::size_t{1} << 20}) {
            if (!ranks.leads()) break;
            Taken taken;
            Team::Plan plan = taken.plan(bytes > 10000 ? 200 : 5000);
            plan.task = [&](std::size_t) { return std::string(bytes, 'x'); };
            plan.take = [](std::size_t, const std::string&) {};
            const auto start = std::chrono::steady_clock::now();
            team.run(plan);
            const std::chrono::duration<double, std::micro> spent = std::chrono::steady_clock::now() - start;
            std::printf("%d ranks, %zu bytes there and back: %.1f us a task\n", ranks.size(), bytes,
                        spent.count() / static_cast<double>(plan.tasks));
        }
        if (ranks.leads()) send_home(ranks);
    }
    ranks.leave(0, false);
}
