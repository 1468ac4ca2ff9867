#include "runtime/team.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vndf::runtime {
namespace {

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds longest_wait(100);

// Between ranks: what it is, and what belongs to it.
enum class Kind { greeting, failure, alive, task, event, home };

std::string packed(Kind kind, const Json& content = nullptr) {
    std::string bytes;
    Json::to_cbor(Json::array({static_cast<int>(kind), content}), bytes);
    return bytes;
}

Json bytes_of(const std::string& text) {
    return Json::binary({text.begin(), text.end()});
}

std::string text_of(const Json& bytes) {
    return {bytes.get_binary().begin(), bytes.get_binary().end()};
}

// Between looks at what other threads and ranks have sent; MPI knows no way to wait for both that leaves a processor idle.
std::chrono::duration<double> pause(const Ranks& ranks) {
    return ranks.size() == 1 ? longest_wait : std::chrono::milliseconds(1);
}

[[noreturn]] void rethrow(int status, const std::string& what) {
    if (status == InputError("").exit_status()) throw InputError(what);
    throw DeviceError(what);
}

}  // namespace

// A worker's result, or what kept it from one.
struct Team::Event {
    static constexpr std::size_t none = ~std::size_t{0};

    std::size_t worker = 0, task = none;
    std::string bytes = {};
    int failure = 0;  // the exit status; then bytes say what it was
    int rank = 0;
};

class Team::Inbox {
  public:
    void put(Event event) {
        const std::lock_guard lock(mutex_);
        events_.push_back(std::move(event));
        arrived_.notify_one();
    }
    // What is there, after at most this time.
    std::deque<Event> take(std::chrono::duration<double> wait) {
        std::unique_lock lock(mutex_);
        arrived_.wait_for(lock, wait, [&] { return !events_.empty(); });
        return std::exchange(events_, {});
    }

  private:
    std::mutex mutex_;
    std::condition_variable arrived_;
    std::deque<Event> events_;
};

// A device and the thread that feeds it.
class Team::Worker {
  public:
    Worker(std::size_t number, const Device& device, const Hire& hire, Inbox& inbox)
        : number_(number),
          inbox_(inbox),
          thread_([this, device, hire](std::stop_token stop) { live(device, hire, stop); }) {}

    void give(std::size_t task, const std::string& bytes) {
        const std::lock_guard lock(mutex_);
        tasks_.emplace_back(task, bytes);
        given_.notify_one();
    }

  private:
    void live(const Device& device, const Hire& hire, const std::stop_token& stop) {
        Event event{number_};
        try {
            const Work work = hire(device);
            for (;;) {
                std::unique_lock lock(mutex_);
                if (!given_.wait(lock, stop, [&] { return !tasks_.empty(); }) || stop.stop_requested())
                    return;
                const auto [task, bytes] = std::move(tasks_.front());
                tasks_.pop_front();
                lock.unlock();
                event.task = task;
                inbox_.put({number_, task, work(bytes)});
                event.task = Event::none;
            }
        } catch (const Error& error) {
            event.bytes = error.what(), event.failure = error.exit_status();
        } catch (const std::exception& error) {
            event.bytes = error.what(), event.failure = DeviceError("").exit_status();
        }
        inbox_.put(event);
    }

    std::size_t number_;
    Inbox& inbox_;
    std::mutex mutex_;
    std::condition_variable_any given_;
    std::deque<std::pair<std::size_t, std::string>> tasks_;
    std::jthread thread_;
};

Team::Team(Ranks& ranks, const std::vector<Device>& devices, const Hire& hire, const Options& options)
    : ranks_(ranks),
      options_(options),
      inbox_(std::make_unique<Inbox>()),
      heard_(static_cast<std::size_t>(ranks.size()), Clock::now()) {
    introduce(devices);
    if (ranks_.leads()) call_roll();
    for (const Device& device : devices)
        workers_.push_back(std::make_unique<Worker>(workers_.size(), device, hire, *inbox_));
}

Team::~Team() = default;

void Team::introduce(const std::vector<Device>& devices) {
    Json greeting{{"identity", options_.identity}, {"host", ranks_.host()}, {"devices", Json::array()}};
    for (const Device& device : devices) greeting["devices"].push_back({device.label(), device.kind()});
    if (ranks_.leads())
        admit(0, packed(Kind::greeting, greeting));
    else
        ranks_.send(0, packed(Kind::greeting, greeting));
}

void Team::call_roll() {
    while (static_cast<int>(here_.size()) < ranks_.size()) collect();
    // The order of arrival is of no account.
    std::stable_sort(members_.begin(), members_.end(),
                     [](const Member& a, const Member& b) { return a.rank < b.rank; });
    if (options_.alike) require_alike();
}

void Team::admit(int rank, const std::string& greeting) {
    const Json said = Json::from_cbor(greeting).at(1);
    const std::string identity = said.at("identity"), host = said.at("host");
    if (identity != options_.identity)
        throw InputError(fmt::format("rank {} on {} would do something else: '{}'; this one does '{}'", rank,
                                     host, identity, options_.identity));
    here_.insert(rank);
    std::size_t worker = 0;
    for (const Json& device : said.at("devices"))
        members_.push_back({rank, worker++, host, device.at(0), device.at(1)});
}

std::string Team::name(const Member& member) const {
    if (ranks_.size() == 1) return fmt::format("device {}", member.worker + 1);
    return fmt::format("device {} of rank {} on {}", member.worker + 1, member.rank, member.host);
}

void Team::require_alike() const {
    const Member& first = members_.front();
    for (const Member& member : members_)
        if (member.kind != first.kind)
            throw InputError(fmt::format(
                "the devices are of different kinds, and results would depend on who does what: {} is '{}', "
                "{} is '{}'; --device all:NAME takes those of that name alone",
                name(first), first.kind, name(member), member.kind));
}

std::string Team::describe() const {
    if (members_.size() == 1) return {};
    if (ranks_.size() == 1) return fmt::format("{} devices", members_.size());
    return fmt::format("{} devices of {} ranks", members_.size(), ranks_.size());
}

// How far a run has come.
struct Team::Course {
    const Plan& plan;
    std::size_t next = 0, taken = 0;
    bool open = true;  // whether further tasks are begun

    // The next task, if it can be begun.
    std::optional<std::string> begin() {
        if (!open || next - taken >= plan.window) return std::nullopt;
        std::optional<std::string> task = next < plan.tasks ? plan.task(next) : std::nullopt;
        open = task.has_value();
        return task;
    }
};

std::size_t Team::run(const Plan& plan) {
    Course course{plan};
    for (;;) {
        course.open = course.open && plan.proceed(course.taken);
        hand_out(course);
        const bool resting =
            std::all_of(members_.begin(), members_.end(), [](const Member& m) { return m.tasks.empty(); });
        if (resting && !course.open && returned_.empty()) return course.taken;
        collect();
        for (auto first = results_.begin(); first != results_.end() && first->first == course.taken;
             first = results_.erase(first))
            plan.take(course.taken++, first->second);
    }
}

// One task for everybody, then a second one, so that nobody waits for the next; but not while others would have none.
void Team::hand_out(Course& course) {
    for (const std::size_t hold : {1, 2})
        for (Member& member : members_) {
            if (!member.fit || member.tasks.size() >= hold) continue;
            if (hold > 1 && course.plan.tasks - course.next < members_.size()) return;
            if (!returned_.empty()) {
                const auto task = returned_.extract(returned_.begin());
                give(member, task.key(), task.mapped());
            } else if (const auto task = course.begin()) {
                give(member, course.next++, *task);
            }
        }
}

void Team::give(Member& member, std::size_t task, const std::string& bytes) {
    member.tasks[task] = bytes;
    if (member.rank == ranks_.rank())
        workers_[member.worker]->give(task, bytes);
    else
        ranks_.send(member.rank, packed(Kind::task, {member.worker, task, bytes_of(bytes)}));
}

// Waits a moment for something to happen, and notes it.
void Team::collect() {
    const auto deadline = Clock::now() + longest_wait;
    bool any = false;
    while (!any && Clock::now() < deadline) {
        while (const auto message = ranks_.receive()) hear(*message), any = true;
        for (const Event& event : inbox_->take(any ? Clock::duration::zero() : pause(ranks_)))
            note(event), any = true;
    }
    require_signs_of_life();
}

void Team::hear(const Ranks::Message& message) {
    heard_[static_cast<std::size_t>(message.from)] = Clock::now();
    const Json content = Json::from_cbor(message.bytes);
    switch (content.at(0).get<Kind>()) {
        case Kind::greeting:
            return admit(message.from, message.bytes);
        case Kind::event:
            return note({content.at(1).at(0), content.at(1).at(1), text_of(content.at(1).at(3)),
                         content.at(1).at(2), message.from});
        case Kind::failure:
            rethrow(content.at(1).at(0), content.at(1).at(1));
        default:
            return;
    }
}

void Team::require_signs_of_life() const {
    for (std::size_t rank = 1; rank < heard_.size(); ++rank)
        if (Clock::now() - heard_[rank] > options_.patience)
            throw LostRank(fmt::format(
                "rank {}{} has been silent for {:.0f} s: the run ends without it, and without a result", rank,
                host_of(static_cast<int>(rank)), options_.patience.count()));
}

std::string Team::host_of(int rank) const {
    for (const Member& member : members_)
        if (member.rank == rank) return " on " + member.host;
    return {};
}

void Team::note(const Event& event) {
    const auto member = std::find_if(members_.begin(), members_.end(), [&](const Member& m) {
        return m.rank == event.rank && m.worker == event.worker;
    });
    if (event.failure != 0) return lose(*member, event);
    member->tasks.erase(event.task);
    results_[event.task] = event.bytes;
}

void Team::lose(Member& member, const Event& event) {
    member.fit = false;
    returned_.merge(member.tasks);
    member.tasks.clear();
    const std::string what = ranks_.size() == 1 ? event.bytes : name(member) + ": " + event.bytes;
    const auto left = std::count_if(members_.begin(), members_.end(), [](const Member& m) { return m.fit; });
    if (left == 0 || event.failure == InputError("").exit_status()) rethrow(event.failure, what);
    options_.lost(fmt::format("{}\n  its work goes to the {} left", what, left));
}

void Team::serve() {
    auto sent = Clock::now();
    const auto send = [&](const std::string& bytes) {
        ranks_.send(0, bytes);
        sent = Clock::now();
    };
    for (;;) {
        while (const auto message = ranks_.receive()) {
            const Json content = Json::from_cbor(message->bytes);
            const Json& what = content.at(1);
            if (content.at(0).get<Kind>() == Kind::home) return;
            workers_.at(what.at(0).get<std::size_t>())->give(what.at(1), text_of(what.at(2)));
        }
        for (const Event& event : inbox_->take(pause(ranks_)))
            send(packed(Kind::event, {event.worker, event.task, event.failure, bytes_of(event.bytes)}));
        if (Clock::now() - sent > options_.patience / 20) send(packed(Kind::alive));
    }
}

void report_failure(Ranks& ranks, const Error& error) {
    ranks.send(0, packed(Kind::failure, {error.exit_status(), ranks.name() + ": " + error.what()}));
}

void send_home(Ranks& ranks) {
    for (int rank = 1; rank < ranks.size(); ++rank) ranks.send(rank, packed(Kind::home));
}

}  // namespace vndf::runtime
