#pragma once

#include <string>
#include <sys/types.h>

namespace irradiff {

/// A program of the user that answers lines: started by the shell, asked a line at a time through its standard input,
/// heard through its standard output.
class OutsideProgram {
 public:
  /// Throws std::system_error if no process can be started.
  explicit OutsideProgram(std::string command);
  /// Closes both pipes and waits for the end of the program, which it does not hasten: one that reads to the end of its
  /// input ends by itself.
  ~OutsideProgram();
  OutsideProgram(const OutsideProgram&) = delete;
  OutsideProgram& operator=(const OutsideProgram&) = delete;

  /// What it answers to a line without its end. Throws std::runtime_error if it has ended or says nothing for half a
  /// minute; then for every further line, at once.
  std::string answer(const std::string& line);

  /// Why it answers no more; empty as long as it does.
  const std::string& failure() const { return failure_; }

 private:
  [[noreturn]] void giveUp(const std::string& reason);
  void write(const std::string& text);

  std::string command_;
  std::string heard_;  ///< beyond the last answer
  std::string failure_;
  pid_t process_ = -1;
  int to_program_ = -1;
  int from_program_ = -1;
};

}  // namespace irradiff
