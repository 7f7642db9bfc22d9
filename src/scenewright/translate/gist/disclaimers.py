"""Finds sentences that say of themselves that they change nothing: "It has rained, which makes no difference".

What enters: the text. What leaves: where such sentences stand, and thanks and greetings. One that tells what a vehicle
does, or holds an amount, is none of them.
"""

from __future__ import annotations

import re

from scenewright.errors import Span
from scenewright.translate.tokens import tokenise

_SENTENCE = re.compile(r"[^.!?\n]+[.!?]?")
_CHANGES_NOTHING = re.compile(
    r"\b(?:(?:plays?|takes?|has|have|is|are) no part|no part of the test|(?:makes?|made) no difference"
    r"|nothing to do with (?:the|this|it)|of no (?:account|importance)|(?:is|are) irrelevant|do(?:es)? not matter"
    r"|(?:nobody|no one|no other (?:vehicle|car)|nothing) else (?:is|on)"
    r"|no other (?:vehicle|car|road user|traffic)s? (?:is|are))\b",
    re.IGNORECASE,
)
# "The test is passed if there is no contact.": a verdict, not what happens
_VERDICT = re.compile(
    r"^\s*(?:the |a |this )?(?:test|run|case|scenario) (?:is|counts as|shall be|should be|will be) "
    r"(?:a )?(?:pass|passed|failed|successful|ok|okay) (?:if|when|as long as) "
    r"(?:there is |there are |we see )?no (?:contact|collision|crash|accident|touch)s?(?: occurs| happens)?\s*[.!]?$",
    re.IGNORECASE,
)
# "Order: not specified."
_UNSPECIFIED = re.compile(
    r"^\s*(?:[a-z]+ ){0,3}[a-z]+ ?(?::|is|are)(?: (?:is|are|left))? ?(?:not specified|unspecified|not prescribed"
    r"|free|none|n/a|irrelevant)"
    r"\s*[.;]?$",
    re.IGNORECASE,
)
# "The point of the test is whether the AV commits too early.": what the test is for
_PURPOSE = re.compile(
    r"^\s*(?:the|our) (?:point|purpose|aim|idea|question|interest|goal|focus)\b.*\b(?:whether|how)\b", re.I
)
# "Many thanks in advance!", "Sorry for my English.", "I hope that makes sense"
_POLITE = re.compile(
    r"^\W*(?:(?:many |a lot of |with )?(?:thanks|thank you|thx|cheers|regards|best regards|kind regards|sincerely"
    r"|sorry|apologies|excuse (?:me|my)|hello|hi|hey|dear|good (?:morning|afternoon|day)|not sure (?:if|whether)"
    r"|i hope|hope (?:this|that|it)|let me know|that's (?:all|it)|that is (?:all|it)|just (?:asking|checking)"
    r"|fight over"
    r"|many thanks|please (?:note|find|forgive)))\b",
    re.IGNORECASE,
)
# "TODO: ask about the antenna.": what the author has to do, not what happens
_NOTE_TO_SELF = re.compile(r"^\s*(?:TODO|NB|PS|FYI):", re.IGNORECASE)
_NAMES = re.compile(
    r"\d|\b(?:ego|av|sut|vut|sv|hero|npc|pov|vehicles?|cars?|van|bus|truck|lorry|brak|accelerat|slow|stop|turn"
    r"|when|until"
    r"|unless|except|if|but|nobody|no one|way|yield|priority|wait|let|goes|drives?|pass"
    r"|driveway|road)",
    re.IGNORECASE,
)
_ABOUT = re.compile(
    r"\d|\b(?:hero|npc|pov|target|van|car|bus|truck|lorry|brak|accelerat|slow|stop|yield|until|when|east|west"
    r"|north|south"
    r"|left|right|straight|driveway|road|before|after)",
    re.IGNORECASE,
)
_TELLS = re.compile(
    r"\d|\b(?:ego|av|sut|hero|npc|pov|under test|our (?:car|vehicle)|brak|accelerat|slow|stop|turn|yield|pass|cross"
    r"|until|when|if|(?:east|west|north|south)|left|right|straight|driveway|conflict|before|after)",
    re.IGNORECASE,
)

_TEST = r"(?:test|scenario|case|run|simulation|experiment|study|exercise|variant|situation|scene|drill)"
# "The result goes into the safety case.", "The main metric is the smoothness of the ego's turn."
_OF_THE_TEST = re.compile(
    rf"^\W*(?:the|this|our|that) (?:\w+ )?(?:metric|KPI|criterion|verdict|evaluation|assessment|result|report|video"
    rf"|recording"
    rf"|log|catalogue|documentation|{_TEST})s? (?:of (?:the|this) {_TEST} )?(?:of the run )?(?:is (?:about|for|part "
    rf"of|used|meant|a|an"
    r"|the)|are|will be|shall be|goes|go|concentrates|focuses|concludes|ends|helps|serves|contributes|contains no"
    r"|covers|was"
    r"|were|looks|deals|checks|examines|measures|can be|has been|belongs|comes from)\b",
    re.IGNORECASE,
)
_CONCLUDES = re.compile(
    rf"^\W*(?:this|that) (?:concludes|ends|completes|is the end of) (?:the|this) {_TEST}\s*[.!]?$", re.IGNORECASE
)
# "No pedestrians or cyclists are involved.", "There are no other events in this scenario."
_NOBODY_ELSE = re.compile(
    rf"^\W*(?:(?:there (?:is|are)|we have|the {_TEST} (?:contains|has|needs)) )?no (?:(?:other|further|additional"
    rf"|more) )?(?:moving )?"
    r"(?:pedestrians?|cyclists?|vehicles?|cars?|traffic|road users?|actors?|events?|agents?|participants?|objects?"
    r"|obstacles?"
    r"|actions?|traffic lights?|parked cars?)(?:,? (?:or|and|nor) (?:other )?(?:pedestrians|cyclists|vehicles|cars"
    r"|objects"
    r"|obstacles|animals|events|actors))?(?: other than these(?: two)?)?(?: (?:is|are|take part|takes part|occur"
    r"|happen|exist"
    r"|appear|will be))?(?: (?:involved|present|needed|planned|there|around|considered|required|on the road|on the "
    r"map))?"
    rf"(?: (?:in|for|during) (?:the|this|either) (?:{_TEST}|vehicle|of them))?\s*[.!]?$",
    re.IGNORECASE,
)
# "Use the default values for everything that is not mentioned here.", "Everything else stays as it is."
_THE_REST = re.compile(
    r"^\W*(?:please )?(?:use (?:the )?defaults?\b|(?:everything|anything|all|whatever) (?:else|(?:that is |that's "
    r"|is )?not "
    r"(?:stated|mentioned|specified|said))\b|(?:everything|anything) else\b|(?:the )?other parameters\b|do not "
    r"worry\b|don['\u2019]t "
    r"worry\b|we are not interested in\b)",
    re.IGNORECASE,
)
_EGO = r"(?:the (?:ego|AV|SUT|VUT|planner)(?: vehicle)?|our (?:car|vehicle|planner|AV)|it)"
_BEHAVES = (
    r"(?:behave|react|respond|cope|collide|hit|touch|block|handle|deal|do anything|notice|understand|recogni[sz]e"
    r"|panic|hesitate"
    r"|be (?:confused|comfortable|irritated)|accept|make use|take the offer|show|know|pull out safely)"
)
# "The ego must neither collide with the hero nor block the road.": what is expected of it, not what happens
_EXPECTED = re.compile(
    rf"^\W*(?:(?:check|verify|make sure|ensure|we expect|success means|expected is|we want to see|I am curious to "
    rf"see|I want to"
    rf" (?:see|know))(?: that| whether| if| how)? {_EGO} [a-z]+|under no circumstances (?:may|must|should) {_EGO} "
    rf"{_BEHAVES}|{_EGO} "
    rf"(?:must|should|shall|may|can|is (?:not )?(?:supposed|expected|allowed|required) to|has to|ought to)(?: "
    rf"(?:not|never|neither"
    rf"|always))? {_BEHAVES})\b",
    re.IGNORECASE,
)
_EXPECTS_MOTION = re.compile(
    r"\d|\b(?:brak|accelerat|slow|stop|yield|wait|until|when|east|west|north|south|left|right|straight|before|after"
    r"|unless|if|turn|pass|cross|first|last|give|speed|signal|indicat)",
    re.IGNORECASE,
)
# "Please run it with both versions of the planner.": what is done with the test
_DO_WITH_IT = re.compile(
    rf"^\W*(?:please |then |finally,? )?(?:run|repeat|execute|record|log|simulate|play|replay|rerun|store|save"
    rf"|file) (?:it|this"
    rf"|that|the {_TEST}|everything) (?:with|on|in|for|under|as|to)\b",
    re.IGNORECASE,
)

# "The press should see it.", "Customers hate it.": people who take no part
_ONLOOKERS = re.compile(
    r"^\W*(?:customers?|users?|the (?:press|public|customer|team|regulator|authority|assessor|technical service"
    r"|reviewers?|auditors?"
    r"|jury|audience|management)|management|auditors|reviewers|regulators|subjects|participants|students"
    r"|passengers) (?:will |would "
    r"|should |must |may )?(?:wants?|hates?|likes?|loves?|expects?|complains?|asks?|reads?|sees?|needs?|notices?"
    r"|judges?|rates?"
    r"|decides?|appreciates?)\b",
    re.IGNORECASE,
)
# "Sketch both speed profiles.", "Assign back to me when done."
_ASKS_READER = re.compile(
    r"^\W*(?:(?:then|finally|afterwards),? )?(?:please )?(?:sketch|explain|discuss|assign|keep|plot|draw|compute"
    r"|report|document|attach"
    r"|upload|send|remember|enjoy|compare|think about|write down|fill in|note down)\b|^\W*your (?:homework|task"
    r"|job) is\b",
    re.IGNORECASE,
)
_TICKET = re.compile(
    r"^\W*(?:severity|status|owner|assignee|reporter|component|labels?|tags?|version|category|verdict|source"
    r"|reference|author|date"
    r"|found in|fixed in)\s*:",
    re.IGNORECASE,
)
# "What we enter in the file is the clearance.", "I expect that subjects read it so."
_WE_NOTE = re.compile(
    r"^\W*(?:what )?(?:i|we) (?:then )?(?:expect|enter|note|record|measure|look at|hope|think|believe|guess|suspect"
    r"|log|evaluate|report"
    r"|file|find this|see this)\b",
    re.IGNORECASE,
)
# "Useful for flushing out planners that creep.", "Scored by impact speed, as usual."
_VALUED = re.compile(
    r"^\W*(?:(?:very |quite |really )?(?:useful|good|handy|important|interesting|nice|ideal|necessary|needed"
    r"|relevant) (?:for|to|in)"
    r"|(?:scored|rated|judged|evaluated|assessed|measured|recorded|tagged|filed|graded) (?:by|as|with|on|under))\b",
    re.IGNORECASE,
)
_IN_PLAY = re.compile(
    r"\b(?:ego|av|sut|vut|vehicle|car|lorry|it|he|she|they|turn|pass|wait|goes|drives?|speed (?:of|is)|faster"
    r"|slower)\b",
    re.IGNORECASE,
)
_AGAIN = re.compile(
    r"\b(?:twice|times|again|repeat|random|wherever|instead|unless|if|another|second|third)", re.IGNORECASE
)


def disclaimers(text: str) -> list[Span]:
    """Return where sentences stand that say that they change nothing."""
    return [
        Span(*found.span())
        for found in _SENTENCE.finditer(text)
        if _VERDICT.search(found.group())
        or (_UNSPECIFIED.search(found.group()) and not _NAMES.search(found.group()))
        or (_PURPOSE.search(found.group()) and not _ABOUT.search(found.group()))
        or ((note := _NOTE_TO_SELF.search(found.group())) and not _NAMES.search(found.group(), note.end()))
        or ((polite := _POLITE.search(found.group())) and not _NAMES.search(found.group(), polite.end()))
        or _CONCLUDES.search(found.group())
        or (_NOBODY_ELSE.search(found.group()) and not re.search(r"\d", found.group()))
        or (_OF_THE_TEST.search(found.group()) and not _tells(found.group()))
        or (
            any(each.search(found.group()) for each in (_ONLOOKERS, _ASKS_READER, _TICKET, _WE_NOTE, _VALUED))
            and not _tells(found.group())
            and not _IN_PLAY.search(found.group())
        )
        or (_THE_REST.search(found.group()) and not _EXPECTS_MOTION.search(found.group()))
        or (_EXPECTED.search(found.group()) and not _EXPECTS_MOTION.search(found.group()))
        or (_DO_WITH_IT.search(found.group()) and not _tells(found.group()))
        or (_CHANGES_NOTHING.search(found.group()) and not _TELLS.search(found.group()))
    ]


def _tells(sentence: str) -> bool:
    """Whether a sentence about the test may tell what happens in it, or what cannot be orchestrated."""
    sentence = re.sub(r"\bwhen (?:done|finished|ready)\b", "", sentence)
    harmless = re.sub(r"\b(?:in|for) (?:everyday |real |road |urban )?traffic\b|\bautomated vehicles\b", "", sentence)
    if _ABOUT.search(harmless) or _AGAIN.search(harmless):
        return True
    return any("unsupported" in token.tags or "negation" in token.tags for token in tokenise(harmless, ""))
