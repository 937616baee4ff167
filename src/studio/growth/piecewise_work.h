// Work that is done piece by piece: where a program has no threads, all who work take turns.
#pragma once

namespace espalier::studio {

class PiecewiseWork {
public:
    virtual ~PiecewiseWork() = default;

    enum class Then { goes_on, waits, ended };
    /// Does the next piece, and says what comes then.
    virtual Then next() = 0;
    /// On a thread of its own, until there is another piece.
    virtual void wait() = 0;
};

}  // namespace espalier::studio
