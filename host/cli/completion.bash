# Completion of clvndf for bash: commands, their options as --help lists them, and functions.
_clvndf() {
    local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} words
    if [ "$COMP_CWORD" = 1 ]; then
        words=$(clvndf --help | sed -n '/^Subcommands:/,$s/^  \([a-z]*\) .*/\1/p')
    elif [ "${word:0:1}" = - ]; then
        words=$(clvndf "$command" --help | grep -o -e '--[a-z-]*')
    else
        case $command in emit | eval) words=$(clvndf list | cut -d ' ' -f 1) ;; esac
    fi
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o default -F _clvndf clvndf
