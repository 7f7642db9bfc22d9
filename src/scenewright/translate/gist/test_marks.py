"""What says beside a name that this vehicle is the one under test, where the name says it already.

What enters: nothing. What leaves: `TEST_MARKS`, patterns with what is left: "Ego (the car we're testing)" is "Ego",
"the vehicle evaluated" is "the test vehicle".
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import EGO, Rules

_TESTED = r"(?:tested|evaluated|assessed|examined|validated|investigated)"
_VEHICLE = r"(?:vehicle|car|one|system|shuttle|robotaxi|truck)"
_BY_US = (
    r"(?:that |which )?we(?:['\u2019]re| are)? (?:test|evaluat|assess|examin|benchmark|validat|investigat)(?:ing|e)?"
)
_MARK = (
    rf"(?:(?:this |that |it |ego )?is )?(?:the |our )?"
    rf"(?:{_TESTED} {_VEHICLE}|test {_VEHICLE}|(?:{_VEHICLE} )?(?:under test|{_TESTED}|being {_TESTED}|to be "
    rf"{_TESTED}(?: in [^()]{{1,30}})?|{_BY_US}))"
)
# "Ego (the one we're testing)", "The ego (under test)"
_IN_BRACKETS = re.compile(rf"\b({EGO}|vehicle under test) \({_MARK}\)", re.IGNORECASE)
# "8 s from the intersection (ego is the vehicle under test)"
_AT_END = re.compile(
    rf" \((?:the )?{EGO} (?:is|being) (?:the |our )?(?:{_TESTED} {_VEHICLE}|test {_VEHICLE}|{_VEHICLE} (?:under "
    rf"test|{_TESTED}))\)",
    re.IGNORECASE,
)
# "Ego under test, eastbound", "the ego, vehicle evaluated, comes"
_BETWEEN = re.compile(
    rf"\b({EGO}|ours)(?:,? under test|, (?:the |our )?{_VEHICLE} (?:{_TESTED}|(?:that (?:is|we)|being) "
    rf"{_TESTED}))(?:,(?= is\b)|(?=,))",
    re.IGNORECASE,
)
# "the vehicle evaluated (the ego)", "the vehicle that we evaluate"
_AFTER = re.compile(
    r"\b(vehicle|car|shuttle|truck|van|one) (?:which is |being )?(?:evaluated|assessed|examined|validated"
    r"|investigated)"
    r"(?= \(|,| is\b| was\b)",
    re.IGNORECASE,
)
# "The prototype, which is the vehicle to be tested, is"
_RELATIVE = re.compile(
    r"(?<=\w), which is (?:the|our) (?:vehicle|car|one) (?:to be tested|under test|that is tested|being tested|we "
    r"test|tested),"
)

# "What is assessed is the saloon's driving function"
_WHAT_IS_TESTED = re.compile(
    rf"(?:(?<=[.!?]\s)|^)What (?:is|we) (?:{_TESTED}|test|evaluate|assess|examine)(?: here)? is (the [\w-]+)"
    r"(?:['\u2019]s (?:driving |automated |planning )?(?:function|system|policy|planner|software|stack"
    r"|behaviou?r))?(?=[,.])"
)

# "Car-to-car rear with a twist": the name of a kind of test, which tells nothing of who is behind
_CAR_TO_CAR = re.compile(
    r"\b(?:car|vehicle)[- ]to[- ](?:car|vehicle) (?:rear|front|head-on|crossing)(?: [a-z]+){0,3}(?=[:.,])",
    re.IGNORECASE,
)


# In this order: what one rule leaves, the next may read.
TEST_MARKS: Rules = (
    (_IN_BRACKETS, r"\1"),
    (_AT_END, ""),
    (_BETWEEN, r"\1"),
    (_AFTER, r"test \1"),
    (_RELATIVE, ", the ego,"),
    (_WHAT_IS_TESTED, r"\1 is under test"),
    (_CAR_TO_CAR, "test"),
)
