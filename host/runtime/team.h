// Numbered pieces of work that do not depend on each other, done by every device of every rank; results come back in order.
//
// Who does which piece depends on who is free. What comes back does not, if the work is the same on every device: neither the
// number of ranks, nor that of devices, nor their speed matters.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "error.h"
#include "runtime/devices.h"
#include "runtime/ranks.h"

namespace vndf::runtime {

// A rank that does not answer: nothing may be waited for that it would have to join.
struct LostRank : DeviceError {
    using DeviceError::DeviceError;
};

class Team {
  public:
    // Makes a task's result, bytes of bytes. Hired once for each device, in the thread that then works; what several
    // share they only read.
    using Work = std::function<std::string(const std::string& task)>;
    using Hire = std::function<Work(const Device& device)>;

    struct Options {
        std::string identity;  // what is done, of what and how: the same for every rank
        bool alike = true;     // whether the devices must be of one kind
        // Told on the leading rank of each member that fails while others are left.
        std::function<void(const std::string& what)> lost = [](const std::string&) {};
        std::chrono::duration<double> patience = std::chrono::minutes(1);  // with a rank that is silent
    };

    // Every rank makes its team, of its own devices. Throws on the leading rank: DeviceError, naming the rank, if one cannot
    // or does not come, InputError if one would do something else or has a device of another kind.
    Team(Ranks& ranks, const std::vector<Device>& devices, const Hire& hire, const Options& options);
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    // What the other ranks do: they work until send_home().
    void serve();

    // All below is for the leading rank.

    std::size_t size() const { return members_.size(); }
    // "4 devices of 2 ranks"; empty for one device of one rank.
    std::string describe() const;

    struct Plan {
        std::size_t tasks = std::numeric_limits<std::size_t>::max();
        // A task is not begun before the one that many before it is taken: for tasks that depend on those.
        std::size_t window = std::numeric_limits<std::size_t>::max();
        // What is sent to who does it; without it its number in digits. Asked for in order; nothing: there is no such task.
        std::function<std::optional<std::string>(std::size_t task)> task = [](std::size_t i) {
            return std::to_string(i);
        };
        // Called in the order of the tasks.
        std::function<void(std::size_t task, const std::string& result)> take;
        // Called at least ten times a second with the number of tasks taken. False: no further task is begun.
        std::function<bool(std::size_t taken)> proceed = [](std::size_t) { return true; };
    };
    // Returns how many tasks were taken, from the first on without a gap. The tasks of a member that fails go to others; when
    // none is left, or the fault is the user's input, its error is thrown. Throws LostRank if a rank falls silent.
    std::size_t run(const Plan& plan);

  private:
    struct Member {
        int rank;
        std::size_t worker;  // of its rank
        std::string host, label, kind;
        std::map<std::size_t, std::string> tasks = {};  // in its hands
        bool fit = true;
    };
    struct Event;
    class Inbox;
    class Worker;

    void introduce(const std::vector<Device>& devices);
    void call_roll();
    void admit(int rank, const std::string& greeting);
    void require_alike() const;
    void collect();
    void require_signs_of_life() const;
    void hear(const Ranks::Message& message);
    void note(const Event& event);
    void lose(Member& member, const Event& event);
    struct Course;
    void hand_out(Course& course);
    void give(Member& member, std::size_t task, const std::string& bytes);
    std::string name(const Member& member) const;
    std::string host_of(int rank) const;

    Ranks& ranks_;
    Options options_;
    std::unique_ptr<Inbox> inbox_;
    std::vector<std::unique_ptr<Worker>> workers_;              // of this rank
    std::vector<Member> members_;                               // of all
    std::vector<std::chrono::steady_clock::time_point> heard_;  // by rank
    std::set<int> here_;                                        // ranks that answered the roll call
    std::map<std::size_t, std::string> returned_;               // tasks of those who were lost
    std::map<std::size_t, std::string> results_;                // not yet taken
};

// To the leading rank, from one that cannot go on.
void report_failure(Ranks& ranks, const Error& error);
// To all others, from the leading one: there is nothing more to do.
void send_home(Ranks& ranks);

}  // namespace vndf::runtime
