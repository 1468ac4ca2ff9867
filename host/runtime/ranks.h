// The processes of a run: those that mpirun started, the first of which leads; or this one alone.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

namespace vndf::runtime {

class Ranks {
  public:
    // Joins the others where mpirun started this process. Throws DeviceError where it did and this build has no MPI.
    Ranks();
    ~Ranks();
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    int rank() const { return rank_; }
    int size() const { return size_; }
    bool leads() const { return rank_ == 0; }
    // Among the ranks of this host, and their number.
    int place() const { return place_; }
    int neighbours() const { return neighbours_; }
    std::string host() const;
    // "rank 3 on HOST"; empty where there is no other.
    std::string name() const;

    struct Message {
        int from;
        std::string bytes;
    };
    // Both return at once, for the thread that made this object alone. Messages between two ranks arrive in their order.
    void send(int to, std::string bytes);
    std::optional<Message> receive();

    // Takes leave of the others: nothing is sent or received after this. Ends all of them, with this status, if they
    // do not take what was sent to them or `at_once`.
    void leave(int status, bool at_once);

  private:
    struct Outgoing;
    void drop_what_arrived();

    int rank_ = 0, size_ = 1, place_ = 0, neighbours_ = 1;
    std::deque<std::unique_ptr<Outgoing>> outgoing_;
};

}  // namespace vndf::runtime
