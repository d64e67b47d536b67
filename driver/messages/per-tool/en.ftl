# The heads of files for one tool each, and what makes such a file wrong.
per-tool-file = TOOL { $tool }: file { $number } of { $count }
per-tool-file-line = TOOL { $tool }: file { $number } of { $count }, line { $first } of the source
per-tool-file-lines = TOOL { $tool }: file { $number } of { $count }, lines { $first } to { $last } of the source
per-tool-spindle-file = THE TOOL IN THE SPINDLE: file { $number } of { $count }
per-tool-spindle-file-line = THE TOOL IN THE SPINDLE: file { $number } of { $count }, line { $first } of the source
per-tool-spindle-file-lines = THE TOOL IN THE SPINDLE: file { $number } of { $count }, lines { $first } to { $last } of the source
per-tool-begin-by-hand = begin at rest, after a reset, with this tool put in and the zero of Z set by it
per-tool-begin-by-hand-in = begin at rest, after a reset, with this tool put in and the zero of Z set by it in { $offset }
per-tool-begin-by-hand-among = begin at rest, after a reset, with this tool put in and the zero of Z set by it in { $others } and { $offset }
per-tool-begin = begin at rest, after a reset, with this tool put in, and the zero of Z as it was for the tool before
per-tool-begin-in-spindle = begin at rest, after a reset, with the tool in the spindle

per-tool-differs = run by itself, the file of a tool differs: { $difference }
per-tool-ends-early = the file of a tool ends early
per-tool-does-more = the file of a tool does more
per-tool-no-end = the file of a tool has no end
per-tool-not-read = the file of a tool is not read back ({ $code })
per-tool-more-than-rest = the file of a tool begins or ends with more than rest: { $event }
