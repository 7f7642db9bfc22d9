"""Turns of phrase that people put beside what they tell: requests, remarks, changes of mind, fillers.

What enters: nothing. What leaves: `ASIDES`, patterns with what is left of them, in their order: "Not sure if this is
the right place, but:" is nothing, "It revokes this and goes" is "It goes". Nothing that is left is longer.
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import BEGINS, Rules

# "Ego = SUT, hero = POV."
_EQUATED = re.compile(
    r"(?:(?<=[.!?]\s)|(?<=\n)|^)(?:Ego ?= ?(?:SUT|VUT|AV|ADS)|(?:SUT|VUT|AV|ADS) ?= ?ego)(?:[,;] (?:and )?"
    r"(?:hero ?= ?(?:POV|NPC|TV|OV|target)|(?:POV|NPC|TV|OV|target) ?= ?hero))?\.(?=\s)",
    re.IGNORECASE,
)
# "It behaves courteously: it brakes", "the left turner that behaves itself"
_BEHAVES = re.compile(
    r"\b((?:he|she|it|the [\w-]+)) behaves(?: (?:itself|himself|herself|\w+ly|well|badly|nicely))?"
    r"(?: and (?=\w+s\b)|: (?=(?:he|she|it|the |from|when|as soon as|once)\b))",
    re.IGNORECASE,
)
_THAT_BEHAVES = re.compile(r",? (?:that|who|which) behaves (?:itself|himself|herself|\w+ly|well|badly)(?=[,.;]| and\b)")
_TRIGGER_KIND = re.compile(
    r"(?:(?<=[.!?;]\s)|(?<=\n)|^)(?:The )?(?:trigger|triggering|condition) is (?:purely |entirely |only )?"
    r"(?:temporal|spatial|time-based|distance-based|by (?:time|distance)|based on (?:time|distances?"
    r"|times))(?:(?=:)|\.(?=\s))",
    re.IGNORECASE,
)
_YOU_HAVE = re.compile(
    r"(?:(?<=[.!?;]\s)|(?<=\n)|^)(?:(?:Then|And|So|Now),? )?(?:You|We|I)(?: (?:also|then|now))? (?:have|got|"
    r"['\u2019]ve got|have got)(?: also)? (?=(?:the|a|an|our|another|one) )",
    re.IGNORECASE,
)
_NOT_SO = re.compile(r"(?:(?<=[.!?;]\s)|^)Not so (?=(?:the|our|a) )")
_FOR_THIS = re.compile(
    r"(?:(?<=[.!?;]\s)|^)(?:For|To do|To achieve|To manage) (?:this|that|it),? (?=(?:it|he|she|the) )"
)
_ALTHOUGH_COULD = re.compile(
    r",? (?:although|though|even though|while) (?:it|he|she|they) (?:could|might|would have had time|should|ought to)"
    r"(?: not)?(?=[.,;]|$)",
    re.IGNORECASE,
)
_WELL = re.compile(
    r"(?:(?<=[.!?]\s)|(?<=\n)|^)(?:right|ok|okay|alright|all right|so|well|now)(?:,| so| then)+ (?=[a-z])", re.I
)
_SET_UP_ONE = re.compile(
    r"(?:(?<=[.!?]\s)|(?<=, )|(?<=\n)|^)(?:for [\w\u2019' ]+ )?(?:can you |could you )?(?:please )?(?:set up|run"
    r"|build|do|create|prepare"
    r"|give me|I need) "
    r"(?:the|a) (?:one|case|test|scenario|situation) (?:with|of|about|for) (?:the|a|an) (?:[\w-]+ ){0,3}[\w-]+:",
    re.IGNORECASE,
)
_LETS_HAVE = re.compile(
    r"(?:(?<=[.!?]\s)|(?<=\n)|^)Let['\u2019]s (?:have|do|start with|take|begin with|try|look at) (?:the |an? "
    r"|another )?"
    r"(?:[\w-]+ ){0,3}?(?:case|one|scenario|situation|variant)(?: first| next| now)?(?: so (?:that )?[^.!?\d]{0,60})?"
    r"[.!](?=\s)",
    re.IGNORECASE,
)
_TURN_DONE = re.compile(r" \(turn (?:complete|completed|done|finished)\)", re.IGNORECASE)
_THINKS_BETTER = re.compile(r",? (?:then )?thinks? better of it(?=,| and\b)", re.IGNORECASE)
_SHOULD_HAVE_SAID = re.compile(
    r"(?:(?<=[.!?]\s)|^)I (?:should|ought to) have (?:said|mentioned)(?: first| before)? that ", re.IGNORECASE
)
_NOT_SURE = re.compile(r"(?:(?<=[.!?]\s)|^)Not sure (?:if|whether) [^.!?:\d]*?,? but[:,]? ", re.IGNORECASE)
_CLOSES_IN = re.compile(
    r"\b(?:Then )?(?:the ego|the AV|the SUT|our car|it|we) (?:then )?(?:closes? (?:in|up)|gets? (?:closer|nearer)"
    r"|catch(?:es)? up|draws? "
    r"(?:closer"
    r"|nearer)),? and (?=when |the moment |as soon as |once )",
    re.IGNORECASE,
)
_BACK_TO_START = re.compile(
    r"(?:(?<=[.!?]\s)|^)(?:To go back|Going back|Back) to the (?:beginning|start|outset)[:,]", re.IGNORECASE
)
_LIKES_IT = re.compile(r",? whether (?:it|he|she|they|we) likes? it or not\b", re.IGNORECASE)
_WITHOUT_CARE = re.compile(
    r"(?<=\w) without (?:looking|hesitat(?:ion|ing)|(?:any )?warning|thinking|further ado|a second thought|delay)"
    r"(?=[,.;]| and\b| but\b|$)",
    re.IGNORECASE,
)
_WHAT_FOLLOWS = re.compile(
    r"(?:(?<=[.!?;]\s)|(?<=\n)|^)What (?:follows|comes next|happens next|happens then):", re.IGNORECASE
)
_BEFORE_ALL = re.compile(r"(?:(?<=[.!?]\s)|(?<=\n))Before (?:all )?(?:that|this), ?", re.IGNORECASE)
_STOPPED_BY_WORDS = re.compile(
    r"(?<= )full stop(?= (?:(?:it|the|when|then|and|so|ego|hero|our|a|initially)\b)|\s*\Z)", re.IGNORECASE
)
_NOTHING_BUT = re.compile(r"\bwants (?:nothing but|no more than|to do no more than|only) to\b", re.IGNORECASE)
_CATCHING_UP = re.compile(
    r", (?:gradually |slowly )?(?:catching up|closing in|drawing nearer)(?: on it| with it)?,(?= is| are)",
    re.IGNORECASE,
)
_NOT_CARING = re.compile(
    r"(?:(?<=[.!?]\s)|^)Not caring about (?:the (?:priority|right of way) of )?(?:the \w+|us|it), (?=the |it )"
    r"|,? without (?:any )?(?:caring about|regard for|looking at|a thought for) (?:(?:the )?(?:ego|AV|SUT)|us)"
    r"(?=\.|;|,(?! (?:who|which|that|whose)\b))",
)
_SO_THAT_IT_TURNS = re.compile(
    r",? (?:where it (?:remains|stays|waits) )?(?:so|in order) that (?:(?:the )?\w+|it|we) (?:may|can|could|might"
    r"|is able to) "
    r"(?:turn|go|drive on|pass|pull out|(?:enter|join|pull out onto) the road(?: from the driveway)?)"
    r"(?: first| ahead)?(?=[.,;]|$)",
    re.IGNORECASE,
)
_RESUMING = re.compile(r", (?:resuming|continuing) its (?:turn|way|drive|journey|course),", re.IGNORECASE)
_REVOKES = re.compile(
    r"\b(?:revokes|revises|reverses|reconsiders|abandons|takes back) (?:this|that|it|its decision|this decision|its "
    r"intention),? "
    r"(?:and (?:then )?)?(?=accelerates|goes|drives|starts|sets|moves)",
    re.IGNORECASE,
)
_WITHOUT_EITHER = re.compile(
    r"\bWithout (?:speeding up|accelerating) (?:or|and) (?:without )?(?:slowing down|slowing|braking)(?: for "
    r"[\w ]{2,20}?)?,",
    re.IGNORECASE,
)
_OPENS_WITH = re.compile(
    r"(?:(?<=[.!?]\s)|^)(?:Our|The) (?:first|opening|initial) (?:frame|scene|shot|picture|image) (?:has|shows|finds) ",
    re.IGNORECASE,
)
_AGAINST_IT = re.compile(
    r"(?:(?<=[.!?]\s)|^)Against (?:it|this|that|the ego) (?:we|I) (?:set|put|place|pit) ", re.IGNORECASE
)
_THEN_BETTER = re.compile(r"\b((?:it|he|she) then) thinks better of it(?:,| and)", re.IGNORECASE)
_GOES_ON_AGAIN = re.compile(
    r"(?:(?<=[.!?;]\s)|^)When (?:it|he|she) (?:goes|drives|moves|carries|rolls) on(?: again)?, (?=it |he |she )",
    re.IGNORECASE,
)
_UNDER_THIS = re.compile(
    r"(?:(?<=[.!?;]\s)|^)Under (?:this|that|these|those) conditions?,? (?=the |it )", re.IGNORECASE
)
_WITHOUT_LETTING = re.compile(
    r",? (?:but )?without (?:letting|allowing) (?:the \w+|it|us) (?:to )?(?:go|pass|turn|through|in)(?: "
    r"first)?(?=[,.;])",
    re.I,
)
_FOR_GOOD = re.compile(r"(?<=stops) for good\b|(?<=stop) for good\b", re.IGNORECASE)
_AS_IT_SHOULD = re.compile(
    r"(?:(?<=[.!?]\s)|^)(?:It|He|She|The \w+) does (?:what|as) (?:it|he|she) (?:should|must"
    r"|ought to)(?: do)?[.:]"
)
_IN_SECONDS = re.compile(
    r"(?:(?<=[.!?]\s)|^)(?:Here,? )?[Ee]verything (?:here )?is (?:given |measured |told )?in (?:seconds|metres"
    r"|meters|times?"
    r"|distances?)\b[^.\d]{0,40}\."
)
_HERE_IS = re.compile(r"\b((?:The|the) (?:ego|hero|AV|SUT|VUT|POV|NPC)(?: vehicle)?) here is (?=an? )")
_ITS_DRIVER = re.compile(r"\bits driver (?=intend|want|mean|meant|plan|wish|is about|was about)", re.IGNORECASE)
_ABBREVIATIONS = re.compile(r" ?\((?:LT|RT) ?/ ?(?:LT|RT) ?=[^)]*\)")
_IN_A_HURRY = re.compile(r"\b(?:who is )?in a (?:great |terrible )?hurry\b", re.IGNORECASE)
_ITS_TURN_TO_WAIT = re.compile(
    r"(?<=[.!?] )(?:But |However, )?([Ii]t|[Hh]e|[Ss]he) waits (?:its|his|her) turn(?:, "
    r"though)?(?=[.:])"
)
_HAVE_IT = re.compile(r"\blets (?:the ego|us|it|the AV|the SUT) have it(?=[:.])")
_LOCATED = re.compile(r"\b(is|are|was|were) (?:located|found|situated|positioned) (?=[\d.]+ |\w+_(?:m|s|ft)\b)")
_FOR_NOBODY = re.compile(r"\b(?:waits|stops|brakes|slows) for nobody\b", re.IGNORECASE)
_SPEED_TO_NOTHING = re.compile(r"\breduces its speed to (?:nothing|nil|naught|nought)\b", re.IGNORECASE)
_CAN_WE = re.compile(
    r"(?:(?<=[.!?]\s)|^)(?:You['\u2019]ll like this one|Here['\u2019]s one with [\w ]{2,30}"
    r"|Say)[.:]? ",
    re.IGNORECASE,
)
_FOR_ITS_PART = re.compile(r", (?:for its part|on its part|in turn|on the other hand),", re.IGNORECASE)

_STARTING_CONDITION = re.compile(r"(?<=[.;] )Starting condition(?=:)|(?<=\n)Starting condition(?=:)", re.IGNORECASE)
_ASKED = re.compile(r"\b(?:when|once|as soon as|if|trigger\w*|moment|until)\b", re.IGNORECASE)
_PLACED = re.compile(r"\d ?(?:m|s|ft|yd)\b|\w+_(?:m|s|ft)\b")

# 'So this one's the "after you, no, after me" deal.'
_NICKNAME = re.compile(
    r"(?:(?<=[.!?]\s)|^)(?:So |OK,? )*(?:this|that|here)(?: one| time)?(?:['\u2019]s| is) (?:the|our|another|a|one "
    r"of the) "
    r"[\"\u201c'\u2018][^\"\u201d\n]{2,60}[\"\u201d'\u2019] (?:deal|case|one|scenario|story|situation|thing|type"
    r"|sort)\.",
    re.IGNORECASE,
)
_OUR_GUY = re.compile(r"\bour (?:guy|man|boy|girl|lad)\b(?!['\u2019])(?= (?!of\b))", re.IGNORECASE)
_UNDER_NOSE = re.compile(
    r",? (?:right |just )?(?:under|in front of) (?:my|our|its|the ego['\u2019]s|the AV['\u2019]s) (?:very "
    r")?nose(?=[.,;:])",
    re.IGNORECASE,
)
_ITSELF_APART = re.compile(
    r"\b((?:the|our) [\w-]+), (?:itself|himself|herself|polite|in a hurry|impatient"
    r"|courteous), ",
    re.I,
)

_CLAIMING = re.compile(
    r",? claiming (?:the|its) (?:driveway|road|gap|right of way|way|space) for (?:itself|himself|herself)(?=[,.;]| "
    r"and\b)",
    re.I,
)
_JUST_WHEN_EXPECTED = re.compile(
    r"(?:(?<=[.!?;]\s)|^)Just (?:when|as) (?:one|you|we|everyone) (?:would |might |could )?expects? (?:the \w+|it"
    r"|us) to "
    r"(?:go|turn|pass|pull out|set off)(?: first| ahead)?, ",
    re.IGNORECASE,
)
_NOT_LETTING = re.compile(
    r"(?:(?<=[.!?;]\s)|^)(?:But )?(?:[Ii]t|[Hh]e|[Ss]he|[Tt]he hero) (?:doesn['\u2019]t|does not) let (?:the \w+|it"
    r"|us) (?:go|pass|turn)"
    r"(?: first)?,? (?:though|however|after all)[,:;] (?=(?:it|he|she|the \w+) (?:then )?(?:moves|sets|drives|goes"
    r"|accelerates|pulls|starts|continues|takes)\b)"
)
_AS_THOUGH_TO_LET = re.compile(
    r",? as (?:though|if) to let (?:the \w+|us|it) (?:go|pass|turn|out|in)(?: ahead| first)?(?=[,.;]| and\b)",
    re.IGNORECASE,
)

_THATS_IT = re.compile(r",? and (?:that['\u2019]s|that is) (?:it|all|that|about it)(?=[.!]|\s*\Z)", re.IGNORECASE)
_LIKE_A_PERSON = re.compile(
    r" like an? (?:true |real |proper |good |perfect |polite )?(?:gentleman|lady|saint|maniac|madman|lunatic|pro"
    r"|professional|shot|rocket|bullet|snail)(?=[,.;:]| and\b)",
    re.IGNORECASE,
)
# "does what we'd expect of a decent driver and brakes", "as it is obliged to"
_AS_EXPECTED = re.compile(
    r"\bdoes what (?:we|you|one|anybody|anyone|everyone)(?:['\u2019]d| would| should| might)? (?:expect|hope for|want)"
    r"(?: (?:of|from) [^,.;:\d]{1,40}?)? and (?=\w+s\b)",
    re.IGNORECASE,
)
_AS_OBLIGED = re.compile(
    r",? as (?:it|he|she) (?:is|was) (?:legally )?(?:obliged|required|supposed|meant|bound|expected|due)(?: by law)?"
    r"(?: to)?(?: do)?(?=[,.;])",
    re.IGNORECASE,
)
# "Here somebody is polite to us."
_IS_POLITE = re.compile(
    r"(?:(?<=[.!?]\s)|^)(?:Here|This time|Now|Then)?,? ?(?:somebody|someone|a driver|another driver) is (?:being )?"
    r"(?:nice|polite|kind|friendly|courteous)(?: (?:to|towards) (?:us|the ego))?[.:](?=\s)",
    re.IGNORECASE,
)
_EVER_SEEN = re.compile(
    r"(?:(?<=[.!?]\s)|^)(?:You know|Know|Ever|Have you ever|Remember) (?:(?!\b(?:ego|hero|the"
    r"|our)\b)[^.!?\d])*\?(?:\s+(?:Same|That['\u2019]s it) "
    r"here\.)?",
    re.IGNORECASE,
)
# "Is the learner awake?" at the end asks what the test is for
_ASKS_OF_EGO = re.compile(
    r"(?<=[.!]\s)(?:Is|Are|Does|Do|Will|Can|How (?:does|do|will)|What (?:does|do|will)|Would) (?:the ego|the AV|the SUT"
    r"|our car|we|the learner|the planner|the stack|the policy) (?:(?!\b(?:or|hero|if|when|unless)\b)[^.!?\d])*\?\s*\Z"
)
_IN_OUR_CAR = re.compile(
    r"\b(we(?:['\u2019]re| are) (?:going|driving|coming|heading|travelling)[^,.;\d]{0,40}?) in (?:our|the) (?:test"
    r"|own) "
    r"(?:car|vehicle)\b",
    re.IGNORECASE,
)
_CONSIDER_TWO = re.compile(
    r"(?:(?<=[.!?]\s)|^)(?:We |Let us |Let['\u2019]s )?consider two (?:\w+ )?(?:vehicles|cars) whose (?:routes"
    r"|paths|ways)"
    r" (?:merge|cross|meet|conflict|intersect|converge)"
    r"(?: (?:in|on|at) the (?:driveway|road|junction|intersection|conflict point))?\.",
    re.IGNORECASE,
)
_SMILES = re.compile(r"(?<=\s)[:;]-?[)(D](?=\s|$)")
_NEXT_ONE = re.compile(
    r"(?:(?<=[.!?]\s)|^)(?:ok(?:ay)?,? )?(?:and )?(?:the )?(?:next|last|final|another) (?:one|test|case|scenario) "
    r"?[.:]",
    re.IGNORECASE,
)
_LIKE_THE_EGO = re.compile(
    rf"{BEGINS}Like (?:the ego|us), (?=(?:it|he|she|the [\w-]+(?: vehicle)?) (?:wants|intends|plans|is going) to )"
)
# "instead of letting the ego go first, the hero accelerates"
_INSTEAD_OF_LETTING = re.compile(
    r"\binstead of (?:letting (?:the ego|us|it) (?:go|pass|turn|through|out|in)(?: first| ahead)?|waiting(?: for "
    r"(?:the ego|us|it))?|yielding(?: to (?:the ego|us|it))?), "
    r"(?=(?:the hero(?: vehicle)?|it|he|she) (?:(?:then|now) )?(?:begins to accelerate|accelerates|goes|sets off"
    r"|pulls)\b)",
    re.IGNORECASE,
)
_I_MEAN_EGO = re.compile(r"(?:(?<=[.!?]\s)|^)By (?:us|we) I mean the ego: we (?=are )")
_NO_YIELD = re.compile(r"(?<=accelerates), no (?:yield|yielding)(?=, (?:passes|goes|crosses)\b)")

_TAG_QUESTION = re.compile(r", (?:right|ok|okay|yes|see)\?(?=\s+[A-Z])")
_AS_BEFORE = re.compile(r", as before(?=[,.;])", re.IGNORECASE)
_WEEKDAY = re.compile(r"(?:(?<=[.!?]\s)|(?<=\n)|^)(?:Mon|Tue|Wed|Thu|Fri|Sat|Sun)\. (?=[A-Z])")


def _starts_it(found: re.Match[str]) -> str:
    """Return "Starting condition" as the trigger where amounts stand before it and nothing else is one."""
    told = _PLACED.search(found.string[: found.start()]) and not _ASKED.search(found.string)
    return "Trigger" if told else found.group()


def _stop_said(found: re.Match[str]) -> str:
    """Return the mark for "full stop" in a dictated text, which has no marks of its own."""
    said = len(re.findall(r"\bfull stop\b", found.string, re.IGNORECASE)) > 2
    return "." if said and not re.search(r"[.;!?]\s", found.string) else found.group()


def _there_is(found: re.Match[str]) -> str:
    """Return "We have", "I also have" as "There's", "There is", and as what is shorter still where it has to be."""
    return next((said for said in ("There is ", "There's ") if len(said) <= len(found.group())), "Here's ")


def _trigger(found: re.Match[str]) -> str:
    """Return "The trigger is temporal:" and "The trigger is by time." as "Trigger:"."""
    return "Trigger:" if found.group().endswith(".") else "Trigger"


# In this order: what one rule leaves, the next may read.
ASIDES: Rules = (
    (_EQUATED, ""),
    (_BEHAVES, r"\1 "),
    (_THAT_BEHAVES, ""),
    (_TRIGGER_KIND, _trigger),
    (_YOU_HAVE, _there_is),
    (_NOT_SO, "But "),
    (_FOR_THIS, ""),
    (_ALTHOUGH_COULD, ""),
    (_WELL, ""),
    (_SET_UP_ONE, ""),
    (_LETS_HAVE, ""),
    (_TURN_DONE, ""),
    (_THINKS_BETTER, ""),
    (_SHOULD_HAVE_SAID, ""),
    (_NOT_SURE, ""),
    (_CLOSES_IN, ""),
    (_BACK_TO_START, "Initially "),
    (_LIKES_IT, ""),
    (_WITHOUT_CARE, ""),
    (_WHAT_FOLLOWS, "Then"),
    (_BEFORE_ALL, ""),
    (_STOPPED_BY_WORDS, _stop_said),
    (_NOTHING_BUT, "wants to"),
    (_CATCHING_UP, ""),
    (_NOT_CARING, ""),
    (_SO_THAT_IT_TURNS, ", yielding"),
    (_RESUMING, ""),
    (_REVOKES, ""),
    (_WITHOUT_EITHER, "At constant speed,"),
    (_OPENS_WITH, "Initially "),
    (_AGAINST_IT, "There is "),
    (_THEN_BETTER, r"\1"),
    (_GOES_ON_AGAIN, "Then "),
    (_UNDER_THIS, "At that moment "),
    (_FOR_GOOD, ""),
    (_AS_IT_SHOULD, ""),
    (_IN_SECONDS, ""),
    (_HERE_IS, r"\1 is "),
    (_ITS_DRIVER, "it "),
    (_ABBREVIATIONS, ""),
    (_IN_A_HURRY, ""),
    (_ITS_TURN_TO_WAIT, r"\1 yields"),
    (_HAVE_IT, "yields"),
    (_LOCATED, r"\1 "),
    (_FOR_NOBODY, "won't yield"),
    (_SPEED_TO_NOTHING, "stops"),
    (_STARTING_CONDITION, _starts_it),
    (_FOR_ITS_PART, ""),
    (_WITHOUT_LETTING, ""),
    (_NICKNAME, ""),
    (_OUR_GUY, "the ego"),
    (_UNDER_NOSE, ""),
    (_ITSELF_APART, r"\1 "),
    (_CLAIMING, " without yielding"),
    (_JUST_WHEN_EXPECTED, "Then "),
    (_NOT_LETTING, "Then "),
    (_AS_THOUGH_TO_LET, ""),
    (_SMILES, "."),
    (_NEXT_ONE, ""),
    (_THATS_IT, ""),
    (_LIKE_A_PERSON, ""),
    (_AS_EXPECTED, ""),
    (_AS_OBLIGED, ""),
    (_IS_POLITE, ""),
    (_EVER_SEEN, ""),
    (_ASKS_OF_EGO, ""),
    (_IN_OUR_CAR, r"\1"),
    (_CONSIDER_TWO, ""),
    (_LIKE_THE_EGO, ""),
    (_INSTEAD_OF_LETTING, ""),
    (_I_MEAN_EGO, "We, the ego, "),
    (_NO_YIELD, ""),
    (_TAG_QUESTION, "."),
    (_AS_BEFORE, ""),
    (_WEEKDAY, ""),
)
