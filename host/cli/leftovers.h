// Nothing stays behind, however the process ends.
#pragma once

#include <string>
#include <vector>

namespace vndf::cli {

// From now on a signal that ends the process removes this file, or this folder if it is empty, first. What is
// named last goes first.
void remove_on_signal(const std::string& path);
void keep_on_signal(const std::string& path);

// Removes what remove_on_signal was told of; safe in a signal handler.
void remove_leftovers();

// A new folder among the temporary ones that goes with the object, and with the process if that ends early: a second
// process waits for the end of this one, whatever it is, and removes the folder. Create it before other threads.
// Throws InputError if there is no place for it.
class TemporaryFolder {
  public:
    explicit TemporaryFolder(const std::string& prefix);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::string& path() const { return path_; }

  private:
    std::string path_;
    int alive_ = -1;  // closed when this process ends
    int keeper_ = -1;
};

// Makes a folder, with those above it. Unless keep() is called, those that were new and are still empty go again.
class NewFolder {
  public:
    explicit NewFolder(const std::string& path);
    ~NewFolder();
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;

    void keep();

  private:
    void remove();

    std::vector<std::string> created_;
};

}  // namespace vndf::cli
