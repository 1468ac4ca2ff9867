#include "runtime/ranks.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <thread>

#include <fmt/format.h>

#include "error.h"
#include "runtime/no_device.h"

#if CLVNDF_MPI
#include <mpi.h>
#endif

namespace vndf::runtime {
namespace {

int number_in(const char* variable) {
    const char* const value = std::getenv(variable);
    return value ? std::atoi(value) : 0;
}

// How many processes a launcher of MPI says that it has started: Open MPI's, or MPICH's, whose word for one others use as well.
int launched() {
    const int by_mpich = number_in("PMI_SIZE");
    return std::max(number_in("OMPI_COMM_WORLD_SIZE"), by_mpich > 1 ? by_mpich : 0);
}

#if CLVNDF_MPI
// Processes that share one cache of PoCL's can crash (pocl issues 430 and 1480): all but a host's first have their own.
void set_own_cache(int place) {
    if (place == 0) return;
    const std::string folder = pocl_cache_folder();
    if (!folder.empty()) setenv("POCL_CACHE_DIR", fmt::format("{}/rank-{}", folder, place).c_str(), 1);
}
#endif

}  // namespace

std::string Ranks::host() const {
    std::array<char, 256> name{};
    gethostname(name.data(), name.size() - 1);
    return name.data();
}

std::string Ranks::name() const {
    return size_ == 1 ? "" : fmt::format("rank {} on {}", rank_, host());
}

#if CLVNDF_MPI

struct Ranks::Outgoing {
    std::string bytes;
    MPI_Request request;
};

Ranks::Ranks() {
    if (launched() == 0) return;
    // MPI looks for devices as well, and a driver reads its settings once: none is to be loaded here.
    setenv("HWLOC_COMPONENTS", "-opencl,-cuda,-nvml,-gl,-levelzero,-rsmi", 0);
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Comm host;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &host);
    MPI_Comm_rank(host, &place_);
    MPI_Comm_size(host, &neighbours_);
    MPI_Comm_free(&host);
    set_own_cache(place_);
}

Ranks::~Ranks() = default;

void Ranks::send(int to, std::string bytes) {
    drop_what_arrived();
    outgoing_.push_back(std::make_unique<Outgoing>(Outgoing{std::move(bytes), {}}));
    Outgoing& message = *outgoing_.back();
    MPI_Isend(message.bytes.data(), static_cast<int>(message.bytes.size()), MPI_CHAR, to, 0, MPI_COMM_WORLD,
              &message.request);
}

void Ranks::drop_what_arrived() {
    std::erase_if(outgoing_, [](const std::unique_ptr<Outgoing>& message) {
        int arrived = 0;
        MPI_Test(&message->request, &arrived, MPI_STATUS_IGNORE);
        return arrived != 0;
    });
}

std::optional<Ranks::Message> Ranks::receive() {
    if (size_ == 1) return std::nullopt;
    drop_what_arrived();
    int there = 0, count = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &there, &status);
    if (there == 0) return std::nullopt;
    MPI_Get_count(&status, MPI_CHAR, &count);
    Message message{status.MPI_SOURCE, std::string(static_cast<std::size_t>(count), '\0')};
    MPI_Recv(message.bytes.data(), count, MPI_CHAR, message.from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return message;
}

void Ranks::leave(int status, bool at_once) {
    if (launched() == 0) return;
    constexpr std::chrono::seconds patience(10);
    const auto start = std::chrono::steady_clock::now();
    for (drop_what_arrived(); !outgoing_.empty(); drop_what_arrived()) {
        if (at_once || std::chrono::steady_clock::now() - start > patience) MPI_Abort(MPI_COMM_WORLD, status);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (at_once) MPI_Abort(MPI_COMM_WORLD, status);
    MPI_Finalize();
}

#else

struct Ranks::Outgoing {};

Ranks::Ranks() {
    if (launched() > 1)
        throw DeviceError(fmt::format(
            "mpirun started {} of this command, which was built without MPI (libopenmpi-dev)", launched()));
}

Ranks::~Ranks() = default;

void Ranks::send(int, std::string) {}

void Ranks::drop_what_arrived() {}

std::optional<Ranks::Message> Ranks::receive() {
    return std::nullopt;
}

void Ranks::leave(int, bool) {}

#endif

}  // namespace vndf::runtime
