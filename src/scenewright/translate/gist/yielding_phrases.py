"""Turns of phrase for who gives way and who does not, moods and changes of heart, with plain words for them.

What enters: nothing. What leaves: `YIELDING_PHRASES`, patterns with what to say instead, in their order: "fails to
respect the priority of the ego" is "won't yield to the ego", "it repents and goes" is "it goes".
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import BEGINS, EGO, PRIORITY, Rules

_EGO = rf"(?:the )?{EGO}"
_HERO = r"(?:the (?:hero|POV|NPC)(?: vehicle)?|it|he|she)"

_NO_NOTICE = re.compile(
    r"\b(?:takes? no (?:notice|account|heed) of|pays? no (?:attention|heed|regard) to|shows? no regard for) "
    r"(?=the |it\b|us\b|me\b|[A-Z])",
    re.IGNORECASE,
)
_DENIES = re.compile(
    r"\b(?:denies|refuses|denied|refused) (the [\w-]+(?: vehicle| car)?|us|it|[A-Z]{2,}) (?:the |its )?"
    rf"{PRIORITY}\b(?: to which (?:it|he|she|we) (?:is|are) entitled| that (?:it|he|she) has)?",
    re.IGNORECASE,
)
_KEEP_RIGHT = re.compile(
    r",? so (?:that )?(we|the ego|the (?:vehicle|car) under test|the AV|the SUT) (?:keeps?|has|have|get to keep"
    r"|retains?) "
    r"(?:the |its |our )?(?:right of way|priority|precedence)(?=[.,;]|$)",
    re.IGNORECASE,
)
_TAKES_RIGHT = re.compile(
    r"\btaking (?:the |its )?(?:right of way|priority|precedence) (?:away )?from (?=the |it\b|us\b|[A-Z])",
    re.IGNORECASE,
)
_MEANS_NOT = re.compile(
    r", (?:which means|meaning|i\.e\.|that is to say) that (?:it|he|she) does not (yield|give way)\b", re.I
)
_FAILS_RIGHT = re.compile(
    r"\b(?:fails? to (?:respect|observe|grant|honou?r|heed)|failing to (?:respect|observe|grant|honou?r|heed)"
    r"|disregards?"
    r"|ignores?|violates?) (?:the (?:right of way|right-of-way|priority|precedence) of (?=the |our |us\b|[A-Z])"
    r"|(?=the [\w-]+['\u2019]s (?:right of way|right-of-way|priority|precedence)))",
    re.IGNORECASE,
)
_TAKES_PRECEDENCE = re.compile(
    r"\btakes (?:the )?(?:precedence|priority|right of way)(?: (?:without (?:being entitled to it|having it)|that "
    r"is not its own"
    r"|it does not have|it has not got))?(?=[:,;.])",
    re.IGNORECASE,
)
_YOU_EXPECT = re.compile(
    r"(?:(?<=[.!?;]\s)|^)(?:You|One|We|Anyone)(?:['\u2019]d| would| might) (?:expect|think|want) "
    rf"(?:it|him|her|the (?!{EGO}\b)[\w-]+) to (?:wait|yield|give way)[.,;:] "
    r"(?:[Bb]ut )?(?:[Ii]t|[Hh]e|[Ss]he) (?:doesn['\u2019]t|does not|won['\u2019]t)\b",
)
_UNWILLING = re.compile(
    r"(?:(?<=[.!?;]\s)|^)(?:Being )?(?:unwilling|not willing|unprepared|refusing|declining) to (?:yield|give way|wait)"
    r"(?: to (?:the \w+|us))?, (it|he|she|the \w+) ",
    re.IGNORECASE,
)
_WINS = re.compile(r"(?<=, and )(the [\w-]+|it|he|she) wins(?: the race| this)?(?=[:;.])", re.IGNORECASE)
_WAITS_FOR_NOTHING = re.compile(r"\b((?:the )?\w+) waits for nothing(?: and nobody)?(?=[:;.,])", re.IGNORECASE)
_DISREGARDING = re.compile(
    r"\b(?:disregarding|ignoring|violating|not respecting|not heeding) (?:the (?:right of way|right-of-way|priority"
    r"|precedence) of "
    r"(the [\w-]+|us)|(the [\w-]+)['\u2019]s (?:right of way|right-of-way|priority|precedence))(?=[,.;]| and\b)",
    re.IGNORECASE,
)
_THUS_NOT = re.compile(
    r",? and (?:thus|therefore|so|hence) (?:does not|doesn['\u2019]t) (?:yield|give way)(?: to (?:the \w+|it"
    r"|us))?(?=[.;])",
    re.I,
)
_OUGHT_BUT = re.compile(
    r"\b(It|He|She|The hero) (?:ought to|should|is supposed to|would have to|has to) (?:let (?:the \w+|us|it) (?:go"
    r"|pass|turn)"
    r"(?: first| ahead)?|wait|yield|give way)(?: (?:for|to) (?:the \w+|us|it))?, but (?:it |he |she )?(?:does not"
    r"|doesn['\u2019]t|"
    r"won['\u2019]t|will not)(?: do so)?\b",
)
_IN_NO_MOOD = re.compile(
    r"\b((?:the )?\w+)(?:['\u2019]s| is) (?:not in an?|in no) [\w-]+ mood(?: today)?: (?=it |he |she )", re.IGNORECASE
)
_REPENTS = re.compile(
    r"\b(it|he|she|the \w+) (?:repents|regrets (?:it|this|that)|has second thoughts|thinks again|reconsiders),? "
    r"(?:and )?"
    r"(?=accelerates|goes|drives|starts|sets|moves|speeds|pulls)",
    re.IGNORECASE,
)
_CHANGE_MIND = re.compile(r"\b(they|we) change (?:their|our) minds?(?:,? and|,)(?= )", re.IGNORECASE)
_NOT_INSIST = re.compile(
    rf"\bdoes not insist on (?:going first|(?:its|his|her|the) {PRIORITY}|it)(?=[.;])", re.IGNORECASE
)
_NOT_RESPECTED = re.compile(
    rf"{BEGINS}The {PRIORITY} of {_EGO} is (?:not respected|disregarded|ignored|neglected)\.", re.IGNORECASE
)
_REFUSES_TO = re.compile(rf"\b(?:refuses|denies) {PRIORITY} to (?={_EGO}|us\b)", re.IGNORECASE)
_LEFT_TO_EGO = re.compile(
    rf"{BEGINS}{PRIORITY} is (?:left|given|granted|conceded|ceded) to ({_EGO}|us)(?=[.,;])", re.IGNORECASE
)
_MANNERS = re.compile(r"\b(the hero|it|he|she) minds (?:its|his|her) manners:", re.IGNORECASE)
_RENOUNCES = re.compile(r"\b(?:renounces|relents|gives in|backs off)(?=[:,] (?:it|he|she|and)\b)", re.IGNORECASE)
_FORGOES = re.compile(
    rf"\b(?:waives|forgoes|renounces|gives up|cedes) (?:its|his|her|the) {PRIORITY}(?: in favour of ({_EGO}"
    rf"|us))?(?=[,:])",
    re.IGNORECASE,
)
_CONTRARY_TO_DUTY = re.compile(
    r",? contrary to (?:its|his|her) (?:obligation|duty) to (?:give way|yield|wait),?", re.IGNORECASE
)


# In this order: what one rule leaves, the next may read.
YIELDING_PHRASES: Rules = (
    (_NO_NOTICE, "won't yield to "),
    (_DENIES, r"won't yield to \1"),
    (_KEEP_RIGHT, r", yielding to \1"),
    (_TAKES_RIGHT, "not yielding to "),
    (_MEANS_NOT, ", not yielding"),
    (_FAILS_RIGHT, "won't yield to "),
    (_TAKES_PRECEDENCE, "won't yield"),
    (_YOU_EXPECT, "It won't yield"),
    (_UNWILLING, r"\1 won't yield and "),
    (_WINS, r"\1 won't wait"),
    (_WAITS_FOR_NOTHING, r"\1 won't wait"),
    (_DISREGARDING, "without yielding"),
    (_THUS_NOT, ", without yielding"),
    (_OUGHT_BUT, r"\1 won't yield"),
    (_IN_NO_MOOD, r"\1 won't yield: "),
    (_REPENTS, r"\1 "),
    (_CHANGE_MIND, r"\1"),
    (_NOT_INSIST, "yields"),
    (_NOT_RESPECTED, "The hero won't yield."),
    (_REFUSES_TO, "won't yield to "),
    (_LEFT_TO_EGO, r"Yielding to \1"),
    (_MANNERS, r"\1 yields:"),
    (_RENOUNCES, "yields"),
    (_FORGOES, "yields"),
    (_CONTRARY_TO_DUTY, " without yielding,"),
)
