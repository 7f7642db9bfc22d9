"""Refuses turns of phrase that no program can say, before any reader steps over them.

What enters: a description. What leaves: nothing, or a refusal that names the words. Each phrase is made of common
words, so that a reader who knows the words alone would lose what they say together.
"""

from __future__ import annotations

import re

from scenewright.errors import Place, Span, TranslationError

_VEHICLES = r"(?:hero|npc|pov|target|opponent|adversary|challenger|ego|av|sut|vut|car|van|bus|truck|lorry|vehicle)"
_SPEED = r"(?:\d+ ?(?:m/s|km/h|kph|mph)\b(?![\^\u00b2])|\w+_(?:mps|kmph|kmh|mph)\b)"
_TAKEN_BACK = (
    r"(?:withdrawn|deleted|cancell?ed|retracted|superseded|void|obsolete|dropped|scrapped|crossed out|removed)"
)
_PHRASES = tuple(
    (re.compile(pattern, re.IGNORECASE), message)
    for pattern, message in (
        (
            rf"\bthere (?:is|are|was|were) no (?!other|second|further|third)(?:\w+ )?{_VEHICLES}\b(?! (?:but|other))",
            "a vehicle that is not there can do nothing",
        ),
        (
            r"(?<![\w.])(?:TBD|TBC|TBA|n/a|x{1,3} (?:s|m|seconds|met(?:er|re)s)|(?<=\w )\[ *\]|\.\.\. ?(?:s|m)\b)(?!\w)"
            r"|\?{2,}|(?<!\w)_{2,}(?!\w)",
            "an amount that is left blank",
        ),
        (
            r"\b(?:why|how come) (?:did|does|do|is|are|was|were|would|should|have|has|had)\b[^?]*\?",
            "what is only asked",
        ),
        (r"\b(?:twice|thrice|repeatedly|several times|again and again)\b", "what happens several times"),
        (r"\bfor the (?:first|second|third|fourth|last|\d+(?:st|nd|rd|th)) time\b", "what happens several times"),
        (
            r"\bsampled\b|\b(?:normal|uniform|random|gaussian) (?:distribution|number|value|draw)s?\b"
            r"|\brandom(?:ly|ised|ized)?\b"
            r"|\bdrawn from\b|\bon average\b|\bdice\b|\bcoin\b",
            "chance",
        ),
        (
            r"\baccelerat\w+ (?:at|with) (?:an? )?(?:unchanging|unchanged|constant|steady|the same) (?:speed"
            r"|velocity)\b",
            "a vehicle that accelerates does not keep its speed",
        ),
        (
            r"\b(?:decelerat|brak|slow)\w*(?: down)?,? (?:at|with) (?:an? )?(?:unchanging|unchanged|constant"
            r"|steady|the same)"
            r" (?:speed|velocity)\b",
            "a vehicle that brakes does not keep its speed",
        ),
        (
            r"\b(?:zebra|pedestrian|level|railway|rail) crossing\b|\bcross ?walk\b|\bbus (?:stop|shelter|lane)\b"
            r"|\broundabout\b",
            "a place that the map does not have",
        ),
        (
            r"\b(?:across|over|onto|on|between) the (?:kerb|curb|grass|verge|pavement|sidewalk|footpath"
            r"|hard shoulder)\b"
            r"|\bin the middle of (?:it|the)\b",
            "a place that no route leads over",
        ),
        (
            r"\b(?:on|at|turns?|goes|shows|until) (?:green|red|amber)\b(?= (?:and|then|to|the|it)\b|[,.;]|$)",
            "a traffic light",
        ),
        (r"\b(?:tail|rear|back)(?:[- ]end)?[- ]first\b|\bback(?:s|ing|ed) out\b", "driving backwards"),
        (r"\bbumper[- ]to[- ]bumper\b|\bclose enough to\b|\bby a (?:hair|whisker)\b", "how close the bodies come"),
        (
            r"\bmakes? as if\b|\bfeints?\b|\bfeigns?\b|\bby the looks? of (?:it|things)\b|\bor so it seems\b",
            "what only seems so",
        ),
        (
            r"\b(?:does|do|did|shall|must|will) not (?:begin|start) to \w+ to\b",
            "what is denied together with its purpose",
        ),
        (
            r"\b(?:holding|keeping|maintaining) (?:a |its )?(?:steady|constant|same|unchanged) speed throughout\b[^.;]*"
            r"\b(?:brak|slow|decelerat|stop)",
            "a vehicle that brakes does not keep its speed",
        ),
        (r"\bat liberty to\b", "what is only allowed"),
        (
            r"\b(?:is|been|being|,|and) waved (?:on|through|across|in|past)\b|(?<=, )waved (?:on|through|across|in"
            r"|past)\b",
            "a gesture",
        ),
        (
            r"\bon second thoughts?\b|\bcome to think of it\b|\bleave the \w+ out\b|\bstruck (?:out|through)\b",
            "what is taken back",
        ),
        (r"\bneither (?:on|in|from|out of) the (?:road|driveway)\b", "a vehicle that is nowhere"),
        (
            r"\b(?:narrowest|smallest|tightest|slimmest|widest|largest|biggest|least|greatest) (?:possible )?"
            r"(?:margin|gap|distance)\b|\bas (?:late|early|close|near|far|little|narrowly|soon) as (?:possible"
            r"|it can|it dares)\b",
            "the most and the least",
        ),
        (
            r"\bwait(?:s|ed|ing)? for (?:a|the|any|some) (?:gap|break|lull|clear road)\b",
            "traffic that is not described",
        ),
        (
            r"\b(?:applies|apply|holds|valid|true) (?:any longer|any more|anymore)\b|\bno longer (?:applies|apply"
            r"|valid)\b"
            rf"|\b(?:sentence|text|description|line|paragraph|sheet|plan|all (?:of )?(?:this|that)) (?:has been"
            rf"|have been|is|was|were)"
            rf" (?:now )?{_TAKEN_BACK}\b|\b(?:not a word|none|nothing) of (?:this|that|it) (?:applies|holds|counts)\b"
            r"|\b(?:scrap|forget|disregard|ignore|strike|delete) (?:that|this|the (?:above|last|previous)"
            r"|all (?:of )?(?:this|that))\b",
            "what is taken back",
        ),
        (
            # no route tells which of several lanes is meant, and "left" alone would be read as a turn
            r"\b(?:left|right|near|off|inner|outer|inside|outside|middle|cent(?:re|er)|fast|slow|passing|overtaking"
            r"|adjacent|next|neighbou?ring)(?:-?hand|most)? lanes?\b",
            "one of several lanes of a road",
        ),
        (
            r"\bon the wrong side\b|\bwrong[- ]way\b|\bside wrong\b|\bghost driver\b|\bagainst the (?:flow|traffic)\b",
            "driving on the wrong side",
        ),
        (
            r"\b(?:draw|plot|make|give|show|print|write|produce|prepare|send)s? (?:me |us )?(?:a|an|the) (?:\w+ )?"
            r"(?:chart|graph|plot|table|diagram|histogram|poem|song|essay|report|summary|statistics|spreadsheet|slide"
            r"|letter|presentation)s?\b",
            "what is asked for is no scenario",
        ),
        (
            r"\b(?:to|at|until|by|of) (?:whatever|whichever)\b|\bwhatever (?:speed|distance|gap|rate"
            r"|the (?:sign|limit|law|rules?|speed))\b",
            "an amount that is not told",
        ),
        (
            r"\b(?:swing|swung|swerve|veer)\w* back\b"
            r"|\b(?:steer|pull|turn)\w* back (?:in(?:to)?|onto|to|towards?)\b(?! the road\b)",
            "a way that no route leads",
        ),
        (
            r"\b(?:runs?|ran|crash(?:es|ed)?|slams?|slammed|bumps?|bumped|ploughs?|drives?|drove) into (?:the"
            r" (?:back|rear|side)"
            r" of|it\b|the ego\b)|\brear-ends\b|\bcollides with\b",
            "a collision is no outcome that is asked for",
        ),
        (
            r"\bside by side\b|\babreast\b|\b(?:inner|outer|nearer|farther) (?:one )?of the two lanes\b|\btwo"
            r" lanes of the"
            r" driveway\b",
            "places beside each other in one lane",
        ),
        (
            r"(?:(?<=[.;] )|(?<=, )|(?<=and )|(?<=but )|(?<=, but, )|(?<=and, )|^)should (?:the|it|our|any|an?|they)\b",
            "what depends on something",
        ),
        (
            r"\b(?:its|the|their|his|her) (?:front|rear|back|front end's|tail) ?(?:bumper|wheels?|axle|end|tyres?"
            r"|tires?|edge)\b"
            r"|\b(?:its|his|her|their) (?:nose|bonnet|tail)\b",
            "a part of a vehicle; places are those of its centre",
        ),
        (
            r"\bbut (?:in|on) the (?:oncoming|opposite|opposing|wrong|other) lane\b|\bfrom the other lane\b"
            r"|\b(?:in|into|on|onto) the (?:outer|inner|far|fast|slow|overtaking|passing|turning|second|third"
            r"|left-hand|right-hand|middle|centre|center) lane\b"
            r"|\bturning bay\b|\blay-?by\b|\bhard shoulder\b|\bcentre line\b|\bcenter line\b|\bpassing place\b",
            "a lane or a place that the map does not have",
        ),
        (
            r"\bnow on,? now off\b|\b(?:on and off|off and on|by turns|bit by bit|in (?:short )?bursts|in stages"
            r"|in steps)\b"
            r"|\bin jerks\b|\bpumping\b",
            "what happens several times",
        ),
        (
            r"\b(?:weav(?:es?|ing|ed)|wove|zig-?zag\w*|slalom\w*|skid\w*|skating|skates|aquaplan\w*|fishtail\w*"
            r"|sideways"
            r"|crosswise|crossways|astride|straddl\w*|squeez(?:es?|ing|ed)|spins? (?:round|around|out))\b",
            "motion off its path",
        ),
        (
            r"\bthe way (?:the [\w-]+|it|we|they|he|she|[A-Z]{2,}) (?:would|does|did|do|might)\b",
            "a manner that is not told",
        ),
        (
            r"\bgone from\b|\bceas(?:es|ed|ing)? to (?:exist|be)\b|\bteleport\w*\b",
            "a vehicle that is not there can do nothing",
        ),
        (
            r"\b(?:radar|lidar|cameras?|sensors?|gps|headlights?|headlamps?|brake lights?|indicators?|mirrors?"
            r"|computer)"
            r" (?:is |are |being |has |have )?(?:been )?(?:off|unplugged|broken|covered|disabled|switched off"
            r"|turned off"
            r"|out of order|failed|dead|blocked|dirty|down)\b",
            "what works in a vehicle and what does not",
        ),
        (
            r"\bcut(?:s|ting)? (?:off )?(?:the|a|that) (?:corner|curve|bend)\b|\bslew(?:s|ed|ing)?\b|\bwheels"
            r" (?:already )?turned\b"
            r"|\bacross both lanes\b",
            "motion off its path",
        ),
        (
            r"\btow(?:s|ed|ing)? (?:rope|bar|line|another|a (?:car|van|vehicle))\b|\bon tow\b"
            r"|\b(?:driver|passengers?|rider)(?: having)? (?:gets?|got|getting|climb\w*|step\w*|jump\w*) (?:out"
            r"|off|down)\b",
            "what somebody else does",
        ),
        (
            r"[,;] waved (?:on|through|across|in|past) by\b|\b(?:hooted|honked|beeped|shouted|waved|flashed"
            r"|whistled) at\b",
            "a gesture",
        ),
        (r"\band again on\b|\bon (?:its|the) way back\b|\bthere and back\b", "what happens several times"),
        (r"\bbrakes (?:fade|fail|lock|give out|overheat|squeal)\w*\b", "what works in a vehicle and what does not"),
        (
            r"\b(?:has|have|had)(?: not|n['\u2019]t)? (?:yet )?(?:noticed|seen|spotted|recogni[sz]ed|detected"
            r"|reali[sz]ed) "
            r"(?:it|him|her|us|the|that)\b"
            r"|\b(?:when|once|as soon as|if) (?:the |its |our )?(?:driver|passenger|rider)[^,.;]{0,40}? feels\b",
            "what somebody perceives",
        ),
        (r"\bas (?:if|though) to (?:turn|go|enter)\b", "what only seems so"),
        (
            r"\bback the way (?:it|he|she|they) came\b|\bcom(?:es|ing) about\b|\bturns? (?:a)?round (?:and|to) go"
            r" back\b",
            "a way that no route leads",
        ),
        (
            r"\b(?:making|makes) (?:the (?:ego|av|sut|vut)|us|the (?:car|vehicle) under test|(?-i:[A-Z]{2,})) (?!wait\b"
            r"|brake\b|yield\b"
            r"|stop\b|react\b|decide\b|slow\b)[a-z]+",
            "what the ego is made to do",
        ),
        (r"\bunder (?:the )?(?:control|command) of\b|\bremote control\b", "who drives a vehicle"),
        (r"\bfor only one of (?:them|the)\b|\bwide enough\b|\btoo narrow\b", "how wide a road is"),
        (
            r"\bleft-hand (?:side of the road|traffic)\b",
            "traffic on the other side of the road",
        ),
        (
            r"\b(?:accelerates?|brakes?|stops|slows down|speeds up|goes|drives on) (?:just )?(?:as|like)"
            r" (?:the ego|the av|we|it|the (?:vehicle|car) under test) (?:does|do)\b",
            "what is tied to what the ego does",
        ),
        (r"\bevery time (?:the|it|that)\b|\beach time (?:the|it|that)\b|\bafresh\b", "what happens several times"),
        (
            r"\b(?:outer|inner|nearer|farther|left|right) of the two (?:[\w-]+ )?lanes\b",
            "a lane or a place that the map does not have",
        ),
        (
            r"\b(?:carries|carried|carry) out (?:its|his|her|the) (?:manoeuvre|maneuver|action|reaction"
            r"|part)(?=\.|,|;|$)",
            "an action that is not told",
        ),
        (
            r"\b(?:given|gets?|getting|got|receiv(?:es?|ing)|seeing|awaits?|awaiting) an? (?:wave|nod|hand signal"
            r"|thumbs[- ]up|honk|hoot|beep|go-ahead|flash|whistle|shout)\b"
            r"|\b(?:at|on|upon|with|after) an? (?:wave|nod|hand signal|honk|hoot|beep|whistle|shout)\b",
            "a gesture",
        ),
        (
            r"\b(?:keeping|holding|maintaining) (?:its|his|her|a steady|a constant|the same) speed,? (?:(?:begins"
            r"|starts) to"
            r" (?:decelerate|brake|slow)|decelerates|brakes|slows|stops)",
            "a vehicle that brakes does not keep its speed",
        ),
        (
            r"\bwithout (?:moving|driving|rolling|setting off|starting)(?: on| off)? again\b",
            "a vehicle that stands passes nothing",
        ),
        (
            r"\bmov(?:es?|ed|ing) (?:over|across) (?:(?:in)?to|one lane|a lane)\b|\b(?:in|to|into|onto) the next "
            r"lane\b",
            "a lane or a place that the map does not have",
        ),
        (
            r"\bas (?:hard|fast|quickly|slowly|sharply|gently|late|far|near|close) (?:from (?:it|the \w+) )?as "
            r"(?:the|it|its|we"
            r"|any|in the (?:last|previous|other))\b",
            "an amount that is not told",
        ),
        (
            r"\b(?:wav|beckon|nodd?|flash|hoot|honk)(?:s|es|ed|ing) (?:it|him|her|us|the [\w-]+) (?:on|through"
            r"|across|past|in|over)\b",
            "a gesture",
        ),
        (
            r"\b(?:has|have|had) (?:broken down|a (?:breakdown|puncture|flat tyre|flat tire))\b|\b(?:can ?not|can't"
            r"|unable to) move\b"
            r"|\bis stuck\b|\bout of (?:fuel|petrol|gas|order)\b",
            "what works in a vehicle and what does not",
        ),
        (r"\bwith (?:its|his|her|the|all) (?:passengers?|occupants?|riders?|load|cargo)\b", "what somebody else does"),
        (
            r"\b(?:pulls?|goes|steers|drives|swings|moves) (?:out )?(?:a)?round (?:it|him|the (?:hero|ego|car|van"
            r"|other))\b",
            "motion off its path",
        ),
        (
            r"\b(?:has|have|had) (?:honked|hooted|beeped|flashed|waved|signalled|signaled|indicated)\b"
            r"|\bstill rolling at\b",
            "a gesture, or a stop that is none",
        ),
        (
            r", (?:just |already |now )?(?:past|beyond) the (?:conflict point|stop line|intersection), is "
            r"[^,.;]{1,30} from\b",
            "a vehicle that is past a place is not before it",
        ),
        (
            r"\bonly (?:applies|apply|holds|valid|happens|occurs|counts|relevant)\b|\b(?:applies|apply|holds|valid"
            r"|relevant) only\b",
            "what holds at times only",
        ),
        (r"\bhorns?\b(?! lane)", "a gesture"),
        (
            r"\bno,? (?:that|this|it) (?:was|is) (?:the other|wrong|not)\b|\bthe other way (?:round|around)\b"
            r"|\balternate (?:days|runs)\b"
            r"|\b(?:these|the|those|them) (?:distances?|times?|amounts?|numbers?|speeds?|figures?)? ?(?:is|are) "
            r"(?:wrong|incorrect)\b",
            "what is taken back",
        ),
        (r"\b(?:next to|alongside) (?:the|a|an) (?!ego\b|hero\b)", "a place beside the road"),
        (
            r"\b(?:the|a) (?:traffic )?(?:light|signal)s? (?:is|are|turns?|goes|shows?|has|have|was|were|changes)\b",
            "a traffic light",
        ),
        (
            r"(?:\d ?\w+|\w_(?:m|s|ft)|\b(?:met(?:er|re)s|seconds|feet|yards)) (?:behind|before|from|short of|past"
            r"|beyond|after|of|to|away"
            r" from|in front of) (?:the|a|its|our) (?:(?:petrol|gas|fuel) station|car park|parking lot|garage"
            r"|factory|shop|school|house"
            r"|supermarket)\b",
            "a place that the map does not have",
        ),
        (
            r"\b(?:place|spot|point|rate|distance|speed) as (?:last|before\b|the last|in the (?:last|previous))"
            r"|\bas last time\b|\bthe (?:second|third|next|other) time (?:that|when|the|it)\b",
            "an amount that is not told",
        ),
        (
            r"\bget(?:s|ting)? (?:a)?round (?:it|him|the (?:hero|ego|car|van|other))\b|\bback(?:s|ing|ed)? up\b",
            "motion off its path",
        ),
        (
            r"\bback (?:to )?where (?:it|he|she|they) (?:started|began|came from|was|were|had been|set out)\b",
            "a way that no route leads",
        ),
        (
            r"(?<=[.!?] )No, (?:make|halve|double|take|swap|say|let|change|put|set|use|rather|better|wait|it was"
            r"|that was"
            r"|not|the other)\b|\b(?:halve|double|swap|exchange) (?:one|both|the two|them|these|their)\b",
            "what is taken back",
        ),
        (
            r"\bwith (?:as (?:little|much)|little|not much|plenty|some|enough|room|time|nothing|next to nothing) to "
            r"spare\b",
            "an amount that is not told",
        ),
        (
            r"\bovert(?:ake|akes|aken|ook|aking) (?:it|him|her|us|the [a-z]+)\b|\b(?:have|has|be|is|been) overtaken\b",
            "overtaking",
        ),
        (
            r"\b(?:one|either|whichever) of (?:the two|them|the (?:two )?(?:vehicles|cars))\b(?:[^.;]|\.\d)*\bthe "
            r"other(?: one)? "
            r"(?:then )?(?:brakes|stops|slows|accelerates|yields|goes|drives|waits)\b",
            "either vehicle, whichever it may be",
        ),
        (
            r"\b(?:rate|deceleration|acceleration) of [\d.]+ ?(?:m/s|km/h|kph|mph|ft/s)(?![\w/^²])",
            "an acceleration in the unit of a speed",
        ),
        (
            r"\b(?:harder|softer|faster|slower|sooner|later|earlier|nearer|closer|farther|further|more|less) than "
            r"(?:(?:it|he|she)"
            r" (?:did|was|had|would|usually|normally)|(?:in|during) the (?:previous|last|first|other)|usual|before)\b",
            "a comparison with what is not told",
        ),
        (
            rf"{_SPEED}[^.;\n]{{0,30}}?\b(?:throughout\b(?! (?:its|the) (?:turn|approach))"
            r"|at all times|all the time|all along|the (?:whole|entire) (?:time|way|test|run|scenario)"
            r"|all the way\b(?=[^.]*\.[^.]*\b(?:accelerat|brak|decelerat|stop))"
            r"|until the (?:very )?end (?:of the (?:test|run|scenario))?|from (?:start|beginning) to (?:finish|end))"
            r"|\b(?:throughout|at all times|all the time|all along),? (?:(?:the|this) (?:whole |entire )?(?:test|run"
            rf"|scenario),? )?[^.;\d\n]{{0,40}}?{_SPEED}"
            r"|\bkeeps? (?:one and the same|the same|a constant|an unchanged|its) speed from [^.;,\d]{3,40} to the "
            r"(?:last|end|very end)\b",
            "a speed for the whole test, in which the hero reacts",
        ),
        (
            r"(?:^|[.!?;]\s+)(?:shortly|just|right|some time|a little|a bit|a moment|moments|well|long|soon) "
            r"(?:before|after) "
            r"(?:the|our|it|he|she|we)\b[^.;]{0,30}?\b(?:is|are|has) [^,.;]{0,12}?(?:\d|\w+_(?:m|s|ft)\b)",
            "a moment of which it is not told how long before or after another one it is",
        ),
        (
            r"\b(?:is|are|comes|gets|being) (?:nearly|almost|practically|virtually|not quite|close to|about) "
            r"(?:at|on|by) (?:the|its) (?:stop line|conflict point|intersection|junction)\b",
            "a place of which it is not told how near it is",
        ),
        (
            r"\b(?:we|they|you|i)(?: will|['\u2019]ll| shall| have yet to| still have to) (?:settle|decide|agree"
            r"|determine)\b"
            r"|\b(?:yet|still|remains) to be (?:settled|decided|agreed|determined|seen)\b",
            "something that is still to be decided",
        ),
        (
            r"\b(?:taking|takes|knock(?:ing|s)|tear(?:ing|s)|rip(?:ping|s)) off (?:the|its|our|his|her)\b(?! (?:gas"
            r"|throttle"
            r"|accelerator|brakes?))",
            "a contact of the two vehicles",
        ),
        (
            rf"(?:^|[.!?;]\s+)Like (?:it|us|(?:the |our )?(?:\w+ )?{_VEHICLES}), [^.;]*?(?:\d|\w+_(?:m|s|ft|mps|mph"
            rf"|kmph)\b)",
            "an amount of which it is not told whether both have it",
        ),
        (r"\broll(?:s|ing|ed)? back\b|\bin reverse\b|\bbacks up\b", "driving backwards"),
    )
)

# "it is 20 m from the stop line and stops there": at the line, or where it is
_STOPS_THERE = re.compile(
    r"\b(?:stops|stopping|halts|(?:comes|coming|brakes|braking) to (?:a |an )?(?:complete |full )?(?:stop|halt"
    r"|standstill|rest))"
    r" (?:right |exactly |just )?(?:there|here|at (?:this|that) (?:spot|place|point))(?=[.;,]|\s*$)",
    re.IGNORECASE,
)


def refuse_unplaced_stop(stops_placed: list[bool], text: str, name: str) -> None:
    """Refuse "and stops there" where no place of a stop was understood; `stops_placed` tells it for each stop.

    Raises
    ------
    TranslationError
        With the phrase.
    """
    found = _STOPS_THERE.search(text)
    if found and stops_placed and not any(stops_placed):
        raise TranslationError(
            "it is not clear where this is",
            place=Place(name, text, Span(*found.span())),
            found=found.group(),
            expected="a place with its name: at the stop line, 5 m before the conflict point",
            fix="name the place at which the hero stops",
        )


def refuse_unsayable(text: str, name: str) -> None:
    """Refuse a text in which a phrase stands that no program can say.

    Raises
    ------
    TranslationError
        With the phrase.
    """
    for pattern, what in _PHRASES:
        if found := pattern.search(text):
            raise TranslationError(
                f"this cannot be orchestrated: {what}",
                place=Place(name, text, Span(*found.span())),
                found=found.group(),
                expected="what two vehicles on the map do, once, with amounts that are told",
                fix="leave it out where it changes nothing, or say it in other words",
            )
