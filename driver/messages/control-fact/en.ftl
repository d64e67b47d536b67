# What ncc assumes of a control or machine where no word and no option states it (NC0308), as heads and accounts show it.
control-fact-PeckClearance = clearance of peck drilling = { $length } mm
control-fact-BreakLift = lift of chip-breaking drilling = { $length } mm
control-fact-StillBlock = block of a compensated contour that goes nowhere = looked over
control-fact-WaitingTool = tool that waits at the start = { $tool }
control-fact-ToolCodeAtStart = { $letter } code of the tool in the spindle at the start = { $number }
control-fact-LengthCodeAtStart = { $letter } code in force at the start = { $number }
control-fact-WordIncrement = increment to which computed words are rounded = { $increment }
control-fact-SystemVariable = { $fact } = yes
control-fact-VariableAtStart = variable { $name } at the start = { $value }
control-fact-ReturnsToCaller = { $code } goes back to a program that calls this one = yes
control-fact-CallersFeed = F where the subprogram begins = that of its caller
control-fact-CallersUnit = unit of length of its caller = { $unit }
control-fact-NoCycleOfCaller = a cycle of the caller's, where a subprogram that may not move begins = none
control-fact-ElseIf = elseif can be worked out where it is passed over = yes
control-fact-NoSuchAxes = axes U, V and W, which the machine does not have = 0
control-fact-AfterMove = { $code } in a block with a move = after the move
control-fact-EndsMain = { $code } ends a main program = yes
control-fact-AlarmsEnd = alarms 61000 to 61999 and 65000 to 66999 = end the program
control-fact-SwivelRecord = only swivel data record = { $name }
control-fact-QuickCode = QU of an M code = with a wait for it
control-fact-InexactComparison = MD 10280 PROG_FUNCTION_MASK bit 0 = 0: real numbers that are nearly equal are not less or greater
control-fact-RoundUpNegative = ROUNDUP of a negative number = towards zero
control-fact-HalfRounded = half of a negative number, rounded = away from zero
control-fact-RepeatCount = P of REPEAT, computed = a whole number, 1 or more
control-fact-Argument = { $name } = { $value }
control-fact-AutomaticClearance = { $name }, automatic = { $length }
control-fact-ComputedClearance = { $name }, automatic = 1/50 of the hole, 0.6 to 7 mm
control-fact-ComputedRadius = { $name }, computed = more than 0
control-fact-MasterSpindle = MD 20090 SPIND_DEF_MASTER_SPIND = 1
control-fact-ManyVariables = MD 28050 MM_NUM_R_PARAM = more than { $number }
control-fact-FineShifts = fine shifts of work offsets ($P_UIFR[…,FI]) = 0
control-fact-DeviceValue = a value that is written to a device = not empty, of no more digits than it has places, blanks before it
control-fact-NearNumbers = numbers that are compared = the same, or further apart than the control's tolerance
control-fact-NearerNumbers = numbers that are compared = the same to more digits than either control looks at, or further apart
control-fact-WholeRemainder = numbers divided for a remainder = whole, as in this program
control-fact-RoundedUp = what is rounded up = never negative, as in this program
control-fact-RoundedDown = what is rounded down = never negative, as in this program
control-fact-Divided = what is divided for a remainder = never negative, as in this program
control-fact-RoundedIncrements = increments that the control rounds = no further off together than its last digit, as in this program
control-fact-Orientation = orientation of the spindle = { $degrees } degrees
control-fact-SpindleZero = zero of angles of the spindle = that of the other machine
control-fact-BoreShift = direction of the shift of fine boring = { $direction }
control-fact-AxisAtStart = { $axis } at the start = { $place }
control-fact-MachineValue = the machine's { $asked }, which the program asks for = what its profile states, else nothing
