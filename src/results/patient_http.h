#pragma once

#include <string>

#include "http.h"

namespace osteon {

/// 408, 425, 429 and 5xx speak of the record store and not of what was sent.
inline bool speaks_of_itself(long status) {
  return status == 408 || status == 425 || status == 429 || status >= 500;
}

/// The first words of an answer, on one line, for a message.
std::string first_words(const std::string& body);

/// Asks again while the record store is busy, three times in all, where `wait` is given. An error:
/// it cannot be reached or stays busy, the rest is for another time.
template <class Ask>
Result<HttpAnswer> asked_patiently(Ask ask, const Wait& wait, const std::string& endpoint) {
  constexpr int kTries = 3;
  constexpr long kLongestWaitS = 30;  // more than that is for another time
  for (int attempt = 1;; ++attempt) {
    Result<HttpAnswer> answer = ask();
    if (!answer || !speaks_of_itself(answer->status)) return answer;
    const long wait_s = answer->retry_after_s.value_or(1L << (attempt - 1));
    if (attempt == kTries || wait_s > kLongestWaitS || !wait)
      return fail("the record store is busy (HTTP " + std::to_string(answer->status) + ")",
                  endpoint, "Nothing is lost: send again later");
    wait(wait_s * 1000);
  }
}

}  // namespace osteon
