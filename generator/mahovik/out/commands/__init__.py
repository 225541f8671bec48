"""The commands: one module each, with one public function of the same name, which Python users call as well."""

COMMANDS: dict[str, dict[str, str]] = {
    "A stand": {
        "new": "Copy an example stand, or make one of a model.",
        "check": "Validate a stand; print its figures.",
        "report": "Write one page on a stand and its proof, or its derivation.",
    },
    "Its C, and the evidence": {
        "generate": "Write the C of a stand, or a project around it.",
        "verify": "Judge the C, a programme or a board's log.",
        "judge": "Judge a program of yours, and find its fault.",
        "evidence": "Collect the evidence for the C in one folder.",
        "eval": "Evaluate states from standard input.",
    },
    "Motion, vibration, programmes": {
        "simulate": "Simulate a stand, or a programme on it.",
        "replay": "Replay a flight log bit for bit.",
        "modes": "Find natural frequencies, damping, shapes.",
        "vibration": "Find steady vibration; meet limits.",
        "plan": "Find a programme that moves the carrier as required.",
    },
    "Measured data, many samples": {
        "identify": "Estimate numbers from measured data.",
        "balance": "Find correction weights of flywheels or of any rotor.",
        "campaign": "Compute many samples whose numbers vary.",
    },
}
"""Commands and what they do, under the headings of `--help`, in the order of use."""
