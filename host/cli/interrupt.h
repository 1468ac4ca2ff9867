// Ctrl-C as a wish: the first asks the command to come to an end, a second ends the process.
#pragma once

namespace vndf::cli {

// While the object lives. Unless the parent had SIGINT ignored, which stays so.
class Interrupt {
  public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    bool asked() const;

  private:
    void (*before_)(int);
};

}  // namespace vndf::cli
