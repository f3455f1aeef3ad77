#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

/// Questions to the oracle of spec/oracle, and what the libraries answer.
namespace halfspace::oracle {

/// A line of numbers; a list is its length and its members.
class Line {
 public:
  void add(std::int64_t number) {
    text_ += std::to_string(number);
    text_ += ' ';
  }
  template <class Members, class AddOne>
  void add_list(const Members& members, AddOne&& add_one) {
    add(static_cast<std::int64_t>(members.size()));
    for (const auto& member : members) add_one(member);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// What a library says, for messages: "ref::merge".
struct Answer {
  const char* who;
  Line line;
};

/// Collects questions with the libraries' answers to them, asks the oracle, and
/// counts what does not agree.
class Inquiry {
 public:
  /// Runs `program` for every batch.
  explicit Inquiry(std::string program) : program_(std::move(program)) {}

  /// Asks, and expects every one of the answers.
  void ask(const Line& question, const std::vector<Answer>& answers);

  /// Has the oracle answer what has been asked. False: it does not answer, or
  /// something did not agree, and standard error says what.
  bool settle();

  std::uint64_t asked() const { return asked_; }

 private:
  struct Expected {
    const char* who;
    std::size_t question;
    std::string text;
  };
  std::string program_;
  std::vector<std::string> questions_;
  std::vector<Expected> expected_;
  std::uint64_t asked_ = 0;
  bool good_ = true;
};

/// Questions about merging on a scan line.
void ask_merges(Inquiry& inquiry, std::uint64_t seed, std::uint64_t count);

/// Questions about splits and relations, and about the orders of trees: as
/// many of either as fit into `count`, at least. How many were asked.
std::uint64_t ask_geometry(Inquiry& inquiry, std::uint64_t seed,
                           std::uint64_t count);

/// All of the table of booleans.
void ask_table(Inquiry& inquiry);

/// Faces in a plane in which the other solid has faces too, of either side.
void ask_classes(Inquiry& inquiry);

}  // namespace halfspace::oracle
