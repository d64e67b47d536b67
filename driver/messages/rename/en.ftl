# Why a name stays: "#100 keeps its name because of …".
rename-form = the form of the new name
rename-taken = the new name, which the program has already
rename-elsewhere = its meaning, which is not set in this text
rename-kept = its value, which other programs may read
rename-kind = the new name, which lives longer or shorter
rename-runs-together = the new name, which runs together with its neighbour
rename-different = the program, which would do something else
rename-not-executed = the program, which ncc cannot execute
