// clvndf: the command.
#include <algorithm>
#include <csignal>
#include <exception>
#include <optional>
#include <string>

#include <fcntl.h>

#include "cli/command_line.h"
#include "cli/driver_failure.h"
#include "cli/streams.h"
#include "error.h"
#include "runtime/team.h"

namespace {

// A file opened while a standard stream is closed would take its number, and what is meant for the stream.
void occupy_standard_streams() {
    for (int stream = 0; stream <= 2; ++stream) {
        // Of the wrong mode, so that using the stream fails as it would have.
        if (fcntl(stream, F_GETFD) < 0) open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY);
    }
}

// Names in messages come from outside: nothing in them may end the line or reach for the terminal.
std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; }, '?');
    return text;
}

// What there is to say of an error, in the words of the leading rank.
void say(vndf::runtime::Ranks& ranks, const vndf::Error& error) {
    if (ranks.leads())
        vndf::cli::remark("clvndf: {}\n", error.what());
    else
        vndf::runtime::report_failure(ranks, error);
}

int run(vndf::runtime::Ranks& ranks, int argc, char** argv, bool& lost) {
    try {
        vndf::cli::CommandLine line(&ranks);
        line.parse(argc, argv);
        return line.run();
    } catch (const vndf::InputError& error) {
        say(ranks, vndf::InputError(one_line(error.what())));
        return error.exit_status();
    } catch (const vndf::Error& error) {
        lost = dynamic_cast<const vndf::runtime::LostRank*>(&error) != nullptr;
        say(ranks, error);
        return error.exit_status();
    } catch (const std::exception& error) {
        say(ranks, vndf::DeviceError(error.what()));
        return 3;
    }
}

}  // namespace

int main(int argc, char** argv) {
    occupy_standard_streams();
    vndf::cli::end_where_drivers_fail();
    std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the limit of file sizes then fails as on a full disk
    std::optional<vndf::runtime::Ranks> ranks;
    try {
        ranks.emplace();
    } catch (const vndf::Error& error) {
        vndf::cli::remark("clvndf: {}\n", error.what());
        return error.exit_status();
    }
    if (!ranks->leads()) vndf::cli::silence_output();
    bool lost = false;
    const int status = run(*ranks, argc, argv, lost);
    if (ranks->leads()) vndf::runtime::send_home(*ranks);
    ranks->leave(status, lost);
    return ranks->leads() ? status : 0;  // mpirun ends with the first that is not 0
}
